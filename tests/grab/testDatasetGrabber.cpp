#include <gtest/gtest.h>
#include <visp3/core/vpFrameGrabberException.h>

#include "movis/grab/dataset_grabber.h"
#include "support/temporary_folder.h"
#include "tiny_dataset.h"

namespace movis::grab {
namespace {

using test::TemporaryFolder;

// Of the picture of a row: see picture().
void expect_picture(const vpImage<vpRGBa>& image, int row, int camera) {
  ASSERT_EQ(image.getWidth(), 32U);
  ASSERT_EQ(image.getHeight(), 24U);
  EXPECT_EQ(int{image[5][6].B}, row);
  EXPECT_EQ(int{image[5][6].G}, 100 + camera);
  EXPECT_EQ(int{image[5][6].R}, 7);
}

template <typename Statement>
void expect_visp_error(Statement statement, int code, std::initializer_list<const char*> parts) {
  try {
    statement();
  } catch (vpFrameGrabberException& error) {
    EXPECT_EQ(error.getCode(), code);
    for (const char* part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << "'" << part << "' not in: " << error.what();
    }
    return;
  }
  ADD_FAILURE() << "no vpFrameGrabberException was thrown";
}

TEST(DatasetGrabber, IsUsedLikeVpVideoReader) {
  const TinyDataset tiny(4);
  DatasetGrabber grabber(tiny.path());
  vpImage<vpRGBa> I;
  EXPECT_EQ(grabber.getNumCameras(), 2U);
  EXPECT_FALSE(grabber.init);
  grabber.open(I);
  EXPECT_TRUE(grabber.init);
  EXPECT_EQ(grabber.getWidth(), 32U);
  EXPECT_EQ(grabber.getHeight(), 24U);
  expect_picture(I, 0, 0);
  int row = 0;
  for (; !grabber.end(); ++row) {
    grabber.acquire(I);
    expect_picture(I, row, 0);
    EXPECT_EQ(grabber.getFrameIndex(), 10 + row);
    EXPECT_NEAR(grabber.getFrameTime(), 0.1 * row, 1e-6);
    EXPECT_EQ(grabber.getFrameName(), (tiny.path() / "images" / (std::to_string(row) + "_M1.png")).string());
  }
  EXPECT_EQ(row, 4);
  expect_visp_error([&] { grabber.acquire(I); }, vpFrameGrabberException::otherError,
                    {"no image after frame 13", "end()"});
  grabber.close();
  EXPECT_FALSE(grabber.init);
  EXPECT_FALSE(grabber.end());
}

TEST(DatasetGrabber, ServesAsAnyFrameGrabber) {
  const TinyDataset tiny(2);
  DatasetGrabber grabber(tiny.path());
  grabber.setCameraIndex(1);
  EXPECT_EQ(grabber.getCameraIndex(), 1U);
  vpFrameGrabber& any = grabber;
  vpImage<vpRGBa> I;
  any.acquire(I);  // opens
  expect_picture(I, 0, 1);
  any.acquire(I);
  expect_picture(I, 1, 1);
  any.close();
  any.acquire(I);
  expect_picture(I, 0, 1);
  grabber >> I;
  expect_picture(I, 1, 1);
}

TEST(DatasetGrabber, ChangingTheCameraStartsOver) {
  const TinyDataset tiny(3);
  DatasetGrabber grabber(tiny.path());
  vpImage<vpRGBa> I;
  grabber >> I >> I;
  expect_picture(I, 1, 0);
  grabber.setCameraIndex(1);
  grabber >> I;
  expect_picture(I, 0, 1);
  expect_visp_error([&] { grabber.setCameraIndex(2); }, vpFrameGrabberException::settingError,
                    {"no camera 2", "2 cameras"});
}

// ViSP's own weights (ITU-R BT.709): 0.2126 · 30 + 0.7152 · 20 + 0.0722 · 200 = 35.1. Those of OpenCV would give 43.5.
TEST(DatasetGrabber, GivesGreyAsVispMakesIt) {
  const TinyDataset tiny(1);
  tiny.write("images/0_M1.png", encoded(cv::Mat(24, 32, CV_8UC3, cv::Scalar(200, 20, 30)), ".png"));
  DatasetGrabber grabber(tiny.path());
  vpImage<unsigned char> I;
  grabber.open(I);
  ASSERT_EQ(I.getWidth(), 32U);
  ASSERT_EQ(I.getHeight(), 24U);
  EXPECT_NEAR(I[3][4], 35.1, 1.0);
  I = 0;
  grabber.acquire(I);
  EXPECT_NEAR(I[3][4], 35.1, 1.0);
  grabber.close();
  I = 0;
  grabber >> I;
  EXPECT_NEAR(I[3][4], 35.1, 1.0);
  EXPECT_TRUE(grabber.end());
}

TEST(DatasetGrabber, PassesOverLostImages) {
  const TinyDataset tiny(4);
  tiny.write("frames.csv", "frame,time_s,M1,M2\n0,0,,\n1,1,images/1_M1.png,\n2,2,,\n3,3,images/3_M1.png,\n4,4,,\n");
  DatasetGrabber grabber(tiny.path());
  vpImage<vpRGBa> I;
  grabber.open(I);
  expect_picture(I, 1, 0);
  EXPECT_EQ(grabber.getFrameIndex(), 1);
  std::vector<long> frames;
  while (!grabber.end()) {
    grabber.acquire(I);
    frames.push_back(grabber.getFrameIndex());
  }
  EXPECT_EQ(frames, (std::vector<long>{1, 3}));
  expect_picture(I, 3, 0);
  grabber.setCameraIndex(1);
  expect_visp_error([&] { grabber.open(I); }, vpFrameGrabberException::initializationError, {"'M2'", "lost"});
  EXPECT_FALSE(grabber.init);
}

TEST(DatasetGrabber, ErrorsAreVisps) {
  const TemporaryFolder folder;
  expect_visp_error([&] { const DatasetGrabber grabber(folder.path() / "100%s"); },
                    vpFrameGrabberException::initializationError, {"100%s", "A data set is a folder"});
  const TinyDataset tiny(3);
  DatasetGrabber grabber(tiny.path());
  vpImage<vpRGBa> I;
  const std::string image = encoded(picture(1, 0), ".png");
  tiny.write("images/1_M1.png", image.substr(0, image.size() - 5));
  grabber >> I;
  for (int again = 0; again < 2; ++again) {
    expect_visp_error([&] { grabber.acquire(I); }, vpFrameGrabberException::otherError,
                      {"frames.csv:3", "'M1'", "1_M1.png", "cut off"});
  }
  EXPECT_EQ(grabber.getFrameIndex(), 10);
  std::filesystem::remove(tiny.path() / "images/2_M1.png");
  expect_visp_error([&] { grabber.open(I); }, vpFrameGrabberException::initializationError,
                    {"frames.csv:4", "'M1'", "2_M1.png"});
  EXPECT_FALSE(grabber.init);
}

}  // namespace
}  // namespace movis::grab
