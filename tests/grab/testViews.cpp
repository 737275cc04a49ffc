#include <gtest/gtest.h>

#include "movis/grab/views.h"
#include "support/temporary_folder.h"

namespace movis::grab {
namespace {

using test::expect_error;

void expect_pixel(const vpImage<vpRGBa>& image, unsigned int v, unsigned int u, const vpRGBa& expected) {
  const vpRGBa found = image[v][u];
  EXPECT_EQ(int{found.R}, int{expected.R}) << "at row " << v << ", column " << u;
  EXPECT_EQ(int{found.G}, int{expected.G}) << "at row " << v << ", column " << u;
  EXPECT_EQ(int{found.B}, int{expected.B}) << "at row " << v << ", column " << u;
  EXPECT_EQ(int{found.A}, int{expected.A}) << "at row " << v << ", column " << u;
}

TEST(ViewOfMat, LooksAtAPartWithoutACopy) {
  const cv::Mat whole(10, 20, CV_8UC3);
  const cv::Mat part = whole(cv::Rect(3, 2, 5, 4));  // begins after 2 rows of 60 bytes and 3 pixels of 3
  const ImageView view = view_of(part);
  EXPECT_EQ(view.data, whole.data + 129);
  EXPECT_EQ(view.width, 5);
  EXPECT_EQ(view.height, 4);
  EXPECT_EQ(view.stride, 60);
  EXPECT_EQ(view.format, PixelFormat::bgr8);
}

TEST(ViewOfMat, FollowsTheTypeUnlessAFormatIsNamed) {
  EXPECT_EQ(view_of(cv::Mat(2, 2, CV_8UC1)).format, PixelFormat::mono8);
  EXPECT_EQ(view_of(cv::Mat(2, 2, CV_8UC1), PixelFormat::bayer_gbrg8).format, PixelFormat::bayer_gbrg8);
  EXPECT_EQ(view_of(cv::Mat(2, 2, CV_8UC3), PixelFormat::rgb8).format, PixelFormat::rgb8);
  EXPECT_EQ(view_of(cv::Mat(2, 2, CV_8UC4), PixelFormat::rgba8).format, PixelFormat::rgba8);
  EXPECT_TRUE(view_of(cv::Mat()).empty());
  EXPECT_TRUE(view_of(cv::Mat(), PixelFormat::rgba8).empty());
}

TEST(ViewOfMat, RefusesWhatNoFormatDescribes) {
  expect_error([] { (void)view_of(cv::Mat(2, 2, CV_8UC4)); }, {"CV_8UC4", "convert it", "name the format"});
  expect_error([] { (void)view_of(cv::Mat(2, 2, CV_16UC3)); }, {"CV_16UC3", "convert it"});
  expect_error([] { (void)view_of(cv::Mat(2, 2, CV_8UC3), PixelFormat::rgba8); }, {"CV_8UC3", "RGBA8", "4 channels"});
  expect_error([] { (void)view_of(cv::Mat(2, 2, CV_16UC1), PixelFormat::mono8); }, {"CV_16UC1", "Mono8", "8 bits"});
}

TEST(ViewOfVpImage, LooksAtRgbaWithoutACopy) {
  vpImage<vpRGBa> image(3, 4);
  image[1][2] = vpRGBa(10, 20, 30, 40);
  const ImageView view = view_of(image);
  EXPECT_EQ(static_cast<const void*>(view.data), image.bitmap);
  EXPECT_EQ(view.width, 4);
  EXPECT_EQ(view.height, 3);
  EXPECT_EQ(view.stride, 16);
  EXPECT_EQ(view.format, PixelFormat::rgba8);
  const std::uint8_t* pixel = view.row(1) + 8;
  EXPECT_EQ(std::vector<int>(pixel, pixel + 4), (std::vector<int>{10, 20, 30, 40}));
  EXPECT_TRUE(view_of(vpImage<vpRGBa>()).empty());
  EXPECT_TRUE(view_of(vpImage<vpRGBa>(0, 0)).empty());
}

// Two rows of two pixels, one byte of padding after each row.
TEST(Copy, PutsTheChannelsOfEveryFormatInPlace) {
  vpImage<vpRGBa> image;
  const std::uint8_t three[] = {1, 2, 3, 4, 5, 6, 0, 7, 8, 9, 10, 11, 12, 0};
  copy({three, 2, 2, 7, PixelFormat::bgr8}, image);
  ASSERT_EQ(image.getWidth(), 2U);
  ASSERT_EQ(image.getHeight(), 2U);
  expect_pixel(image, 0, 1, vpRGBa(6, 5, 4, 255));
  expect_pixel(image, 1, 0, vpRGBa(9, 8, 7, 255));
  copy({three, 2, 2, 7, PixelFormat::rgb8}, image);
  expect_pixel(image, 0, 1, vpRGBa(4, 5, 6, 255));
  expect_pixel(image, 1, 0, vpRGBa(7, 8, 9, 255));
  const std::uint8_t four[] = {1, 2, 3, 4, 5, 6, 7, 8, 0, 9, 10, 11, 12, 13, 14, 15, 16, 0};
  copy({four, 2, 2, 9, PixelFormat::rgba8}, image);
  expect_pixel(image, 0, 1, vpRGBa(5, 6, 7, 8));
  expect_pixel(image, 1, 0, vpRGBa(9, 10, 11, 12));
  const std::uint8_t one[] = {1, 2, 0, 3, 4, 0};
  copy({one, 2, 2, 3, PixelFormat::mono8}, image);
  expect_pixel(image, 0, 1, vpRGBa(2, 2, 2, 255));
  expect_pixel(image, 1, 0, vpRGBa(3, 3, 3, 255));
}

TEST(Copy, ReusesMemoryOfTheSameSize) {
  vpImage<vpRGBa> image(24, 32);
  const vpRGBa* before = image.bitmap;
  const cv::Mat blue(24, 32, CV_8UC3, cv::Scalar(255, 0, 0));
  copy(view_of(blue), image);
  EXPECT_EQ(image.bitmap, before);
  expect_pixel(image, 23, 31, vpRGBa(0, 0, 255, 255));
}

TEST(Copy, AnEmptyViewEmptiesTheImage) {
  vpImage<vpRGBa> image(24, 32);
  copy({}, image);
  EXPECT_EQ(image.getSize(), 0U);
  const std::uint8_t grey = 9;
  copy({&grey, 1, 1, 1, PixelFormat::mono8}, image);
  expect_pixel(image, 0, 0, vpRGBa(9, 9, 9, 255));
}

// A mosaic of one colour (200, 100, 50) over an image that is dark blue in its right half, (0, 0, 80): away from the
// seam between columns 5 and 6 bilinear interpolation gives both back exactly, and a wrong order of the pattern does
// not.
TEST(Copy, InterpolatesEveryBayerOrder) {
  const std::pair<PixelFormat, const char*> patterns[] = {{PixelFormat::bayer_rggb8, "RGGB"},
                                                          {PixelFormat::bayer_bggr8, "BGGR"},
                                                          {PixelFormat::bayer_grbg8, "GRBG"},
                                                          {PixelFormat::bayer_gbrg8, "GBRG"}};
  for (const auto& [format, pattern] : patterns) {
    SCOPED_TRACE(pattern);
    cv::Mat mosaic(8, 12, CV_8UC1);
    for (int v = 0; v < mosaic.rows; ++v) {
      for (int u = 0; u < mosaic.cols; ++u) {
        const char colour = pattern[2 * (v % 2) + u % 2];
        const bool left = u < 6;
        const int value = colour == 'R' ? (left ? 200 : 0) : colour == 'G' ? (left ? 100 : 0) : (left ? 50 : 80);
        mosaic.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(value);
      }
    }
    vpImage<vpRGBa> image;
    copy(view_of(mosaic, format), image);
    for (const unsigned int v : {0U, 1U, 4U, 7U}) {
      for (const unsigned int u : {0U, 1U, 2U, 3U, 4U}) expect_pixel(image, v, u, vpRGBa(200, 100, 50, 255));
      for (const unsigned int u : {7U, 8U, 9U, 10U, 11U}) expect_pixel(image, v, u, vpRGBa(0, 0, 80, 255));
    }
  }
}

// Two sets of two cameras; the second camera's second image is lost.
class TwoSets : public ImageSource {
 public:
  void open() override {}
  bool acquire(FrameSet& set) override {
    if (count_ == 2) return false;
    set.frames.resize(2);
    set.memory = {cv::Mat(2, 3, CV_8UC1, cv::Scalar(count_)), cv::Mat(4, 5, CV_8UC1, cv::Scalar(10 + count_))};
    for (std::size_t k = 0; k < 2; ++k) set.frames[k].view = view_of(set.memory[k]);
    if (count_ == 1) set.frames[1].view = {};
    ++count_;
    return true;
  }
  void close() override {}

 private:
  int count_ = 0;
};

TEST(Acquire, GivesOneImageOfVispForEachCamera) {
  TwoSets source;
  FrameSet set;
  std::vector<vpImage<vpRGBa>> images;
  ASSERT_TRUE(acquire(source, set, images));
  ASSERT_EQ(images.size(), 2U);
  expect_pixel(images[0], 1, 2, vpRGBa(0, 0, 0, 255));
  expect_pixel(images[1], 3, 4, vpRGBa(10, 10, 10, 255));
  ASSERT_TRUE(acquire(source, set, images));
  expect_pixel(images[0], 1, 2, vpRGBa(1, 1, 1, 255));
  EXPECT_TRUE(set.frames[1].lost());
  EXPECT_EQ(images[1].getSize(), 0U);
  EXPECT_FALSE(acquire(source, set, images));
  expect_pixel(images[0], 1, 2, vpRGBa(1, 1, 1, 255));
}

}  // namespace
}  // namespace movis::grab
