#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "movis/grab/dataset_source.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"
#include "tiny_dataset.h"

namespace movis::grab {
namespace {

using test::expect_error;
using test::TemporaryFolder;

std::vector<int> pixel(const ImageView& view, int v, int u) {
  const std::uint8_t* first = view.row(v) + std::ptrdiff_t{u} * channels(view.format);
  return {first, first + channels(view.format)};
}

// A data set of one frame with one camera, whose image is this file.
void write_single(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
  folder.write("rig.yaml", rig_text({"M1"}));
  folder.write("frames.csv", "frame,time_s,M1\n0,0," + name + "\n");
  folder.write(name, content);
}

FrameSet read_single(const TemporaryFolder& folder) {
  DatasetSource source(read_dataset(folder.path()));
  source.open();
  FrameSet set;
  EXPECT_TRUE(source.acquire(set));
  return set;
}

// What a run over a whole data set yields: numbers, times and pixels.
std::vector<double> everything(DatasetSource& source) {
  std::vector<double> values;
  for (FrameSet set; source.acquire(set);) {
    values.push_back(static_cast<double>(set.index));
    values.push_back(set.time_s);
    for (const Frame& frame : set.frames) {
      values.push_back(frame.time_s);
      for (int v = 0; v < frame.view.height; ++v) {
        values.insert(values.end(), frame.view.row(v), frame.view.row(v) + std::ptrdiff_t{3} * frame.view.width);
      }
    }
  }
  return values;
}

TEST(DatasetSource, DeliversSetsInTheOrderOfTheFile) {
  const TinyDataset tiny(20);
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  FrameSet set;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(source.acquire(set));
    EXPECT_EQ(set.index, 10 + i);
    EXPECT_NEAR(set.time_s, 0.1 * i, 1e-6);
    ASSERT_EQ(set.frames.size(), 2U);
    for (int k = 0; k < 2; ++k) {
      const Frame& frame = set.frames[static_cast<std::size_t>(k)];
      EXPECT_NEAR(frame.time_s, 0.1 * i, 1e-6);
      ASSERT_FALSE(frame.lost());
      EXPECT_EQ(frame.view.width, 32);
      EXPECT_EQ(frame.view.height, 24);
      EXPECT_EQ(frame.view.format, PixelFormat::bgr8);
      EXPECT_EQ(pixel(frame.view, 23, 31), (std::vector<int>{i, 100 + k, 7}));
    }
  }
  EXPECT_FALSE(source.acquire(set));
  EXPECT_EQ(set.index, 29);  // untouched
  EXPECT_FALSE(source.acquire(set));
}

TEST(DatasetSource, LostImagesAreEmptyViews) {
  const TinyDataset tiny(2);
  tiny.write("frames.csv",
             "frame,time_s,M1,M2,M2_time_s\n0,1,images/0_M1.png,images/0_M2.png,1.5\n1,2,,images/1_M2.png,2.5\n"
             "2,3,,,\n3,4,images/1_M1.png,,4.5\n");
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  const bool lost[4][2] = {{false, false}, {true, false}, {true, true}, {false, true}};
  const double times[4][2] = {{1, 1.5}, {2, 2.5}, {3, 3}, {4, 4.5}};
  FrameSet set;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(source.acquire(set));
    ASSERT_EQ(set.frames.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(set.frames[k].lost(), lost[i][k]) << i << " " << k;
      EXPECT_DOUBLE_EQ(set.frames[k].time_s, times[i][k]) << i << " " << k;
    }
  }
  EXPECT_EQ(pixel(set.frames[0].view, 0, 0), (std::vector<int>{1, 100, 7}));
  EXPECT_FALSE(source.acquire(set));
}

TEST(DatasetSource, EveryRunYieldsTheSame) {
  const TinyDataset tiny(15);
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  const std::vector<double> first = everything(source);
  EXPECT_EQ(first.size(), 15U * (2U + 2U * (1U + 32U * 24U * 3U)));
  source.open();
  EXPECT_EQ(everything(source), first);
  DatasetSource another(read_dataset(tiny.path()));
  another.open();
  EXPECT_EQ(everything(another), first);
}

TEST(DatasetSource, OpenedAgainItStartsOver) {
  const TinyDataset tiny(10);
  DatasetSource source(read_dataset(tiny.path()));
  FrameSet set;
  source.open();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(source.acquire(set));
  source.open();
  ASSERT_TRUE(source.acquire(set));
  EXPECT_EQ(set.index, 10);
  source.close();
  source.open();
  ASSERT_TRUE(source.acquire(set));
  EXPECT_EQ(set.index, 10);
}

TEST(DatasetSource, AcquireNeedsAnOpenSource) {
  const TinyDataset tiny(2);
  DatasetSource source(read_dataset(tiny.path()));
  FrameSet set;
  expect_error([&] { source.acquire(set); }, {tiny.path().c_str(), "not open", "call open()"});
  source.open();
  ASSERT_TRUE(source.acquire(set));
  source.close();
  source.close();
  expect_error([&] { source.acquire(set); }, {"not open"});
  EXPECT_EQ(pixel(set.frames[0].view, 5, 5), (std::vector<int>{0, 100, 7}));  // outlives the source's closing
}

TEST(DatasetSource, ClosesWhileItDecodes) {
  const TinyDataset tiny(60);
  for (int acquired = 0; acquired < 12; ++acquired) {
    DatasetSource source(read_dataset(tiny.path()));
    FrameSet set;
    source.open();
    for (int i = 0; i < acquired; ++i) ASSERT_TRUE(source.acquire(set));
    if (acquired % 3 == 0) source.close();
    if (acquired % 3 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));  // until it waits for room
  }                                                                                     // destroyed
}

TEST(DatasetSource, DecodesOnlyAFewSetsAhead) {
  const TinyDataset tiny(40);
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // time enough to decode all 40
  std::filesystem::remove(tiny.path() / "images/20_M1.png");
  FrameSet set;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(source.acquire(set));
  expect_error([&] { source.acquire(set); }, {"frames.csv:22", "'M1'", "20_M1.png", "cannot be read"});
}

// Every matrix seen is kept alive, so memory that was given back could not come again at the same address.
TEST(DatasetSource, ReusesTheMemoryOfItsSets) {
  const TinyDataset tiny(40);
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  std::vector<cv::Mat> seen;
  std::set<const std::uint8_t*> addresses;
  for (FrameSet set; source.acquire(set);) {
    EXPECT_EQ(set.frames[0].view.data, set.memory[0].data);
    seen.push_back(set.memory[0]);
    addresses.insert(set.frames[0].view.data);
  }
  EXPECT_EQ(seen.size(), 40U);
  EXPECT_LE(addresses.size(), 5U);  // four ahead and the caller's
}

TEST(DatasetSource, ASetThatIsMovedAwayKeepsItsImages) {
  const TinyDataset tiny(20);
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  std::vector<FrameSet> kept;
  for (FrameSet set; source.acquire(set);) kept.push_back(std::move(set));
  ASSERT_EQ(kept.size(), 20U);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(pixel(kept[static_cast<std::size_t>(i)].frames[1].view, 3, 3), (std::vector<int>{i, 101, 7}));
  }
}

TEST(DatasetSource, MissingImagesAreFoundBeforeAnyWork) {
  const TinyDataset tiny(10);
  DatasetSource source(read_dataset(tiny.path()));
  std::filesystem::remove(tiny.path() / "images/9_M2.png");
  expect_error([&] { source.open(); }, {"frames.csv:11", "'M2'", "images/9_M2.png"});
  FrameSet set;
  expect_error([&] { source.acquire(set); }, {"not open"});
  tiny.write("images/9_M2.png", encoded(picture(9, 1), ".png"));
  source.open();
  EXPECT_TRUE(source.acquire(set));
}

TEST(DatasetSource, AnErrorComesInItsTurnAndStays) {
  const TinyDataset tiny(8);
  tiny.write("images/5_M1.png", "this is no image");
  DatasetSource source(read_dataset(tiny.path()));
  FrameSet set;
  for (int run = 0; run < 2; ++run) {
    source.open();
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(source.acquire(set));
      EXPECT_EQ(set.index, 10 + i);
    }
    for (int again = 0; again < 2; ++again) {
      expect_error([&] { source.acquire(set); }, {"frames.csv:7", "'M1'", "images/5_M1.png", "cannot be decoded"});
    }
  }
}

TEST(DatasetSource, ARigThatInsistsOnAnotherFormatIsRefused) {
  const TinyDataset tiny(1);
  tiny.write("rig.yaml", rig_text({"M1", "M2"}, 32, 24, ", format: BayerRG8"));
  DatasetSource refused(read_dataset(tiny.path()));
  expect_error([&] { refused.open(); }, {"rig.yaml", "'M1'", "BayerRG8", "BGR8", "remove"});
  tiny.write("rig.yaml", rig_text({"M1", "M2"}, 32, 24, ", format: BGR8"));
  DatasetSource accepted(read_dataset(tiny.path()));
  EXPECT_NO_THROW(accepted.open());
}

TEST(DatasetSource, AnotherSizeThanTheRigsIsRefused) {
  const TinyDataset tiny(3);
  tiny.write("images/2_M2.png", encoded(cv::Mat(32, 24, CV_8UC3), ".png"));
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  FrameSet set;
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(source.acquire(set));
  expect_error([&] { source.acquire(set); },
               {"frames.csv:4", "'M2'", "images/2_M2.png", "24x32", "rig.yaml says 32x24", "name the rig"});
}

std::string with_flipped_byte(std::string content, std::size_t at) {
  content[at] = static_cast<char>(~content[at]);
  return content;
}

// The image stands after others, so that it would be decoded into memory that holds one of them.
TEST(DatasetImage, WhatIsNoImageIsRefused) {
  const TinyDataset tiny(12);
  DatasetSource source(read_dataset(tiny.path()));
  const auto expect_refused = [&](const std::string& content, const char* what) {
    tiny.write("images/10_M1.png", content);
    source.open();
    FrameSet set;
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(source.acquire(set));
    expect_error([&] { source.acquire(set); }, {"frames.csv:12", "'M1'", "10_M1.png", what});
  };
  const std::string image = encoded(picture(10, 0), ".png");
  expect_refused("", "empty file");
  expect_refused("text", "cannot be decoded");
  expect_refused(with_flipped_byte(image, 30), "cannot be decoded");                // checksum of the header
  expect_refused(with_flipped_byte(image, image.size() / 2), "cannot be decoded");  // data
}

// OpenCV cannot say whether it decoded into given memory; src/dataset_image.cpp tells it by a pixel of this colour.
TEST(DatasetImage, AnImageMayHaveAnyColour) {
  const TinyDataset tiny(12);
  const cv::Scalar mark(1, 254, 3);
  tiny.write("images/10_M1.png", encoded(cv::Mat(24, 32, CV_8UC3, mark), ".png"));
  DatasetSource source(read_dataset(tiny.path()));
  source.open();
  FrameSet set;
  for (int i = 0; i < 11; ++i) ASSERT_TRUE(source.acquire(set));
  EXPECT_EQ(cv::norm(set.memory[0], cv::Mat(24, 32, CV_8UC3, mark), cv::NORM_INF), 0.0);
}

// Cut off anywhere, a file is refused (tried in steps of 5, and for each of its last 20 bytes); whole, and with bytes
// after its end, it is read. `first` is the shortest beginning by which the kind of the file is known.
void expect_only_whole(const std::string& name, const std::string& content, std::size_t first) {
  const TemporaryFolder folder;
  write_single(folder, name, content);
  DatasetSource source(read_dataset(folder.path()));
  FrameSet set;
  for (const char* trailing : {"", "\n", "trailing \xFF\xD9 bytes"}) {
    folder.write(name, content + trailing);
    source.open();
    EXPECT_TRUE(source.acquire(set));
  }
  for (std::size_t size = 1; size < content.size(); size += size + 20 < content.size() ? 5 : 1) {
    SCOPED_TRACE(size);
    folder.write(name, content.substr(0, size));
    source.open();
    const char* what = size < first ? "cannot be decoded" : "is cut off before its end; copy it again";
    expect_error([&] { source.acquire(set); }, {"frames.csv:2", "'M1'", name.c_str(), what});
  }
}

// Colourful enough for entropy-coded data with stuffed bytes.
cv::Mat pattern() {
  cv::Mat image(24, 32, CV_8UC3);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST(DatasetImage, APngThatWasCutOffIsRefused) {
  expect_only_whole("a.png", encoded(picture(1, 0), ".png"), 8);
}

TEST(DatasetImage, AJpegThatWasCutOffIsRefused) {
  const std::string plain = encoded(pattern(), ".jpg");
  EXPECT_NE(plain.find(std::string("\xFF\x00", 2)), std::string::npos);  // a stuffed byte
  expect_only_whole("a.jpg", plain, 2);
}

TEST(DatasetImage, AProgressiveJpegThatWasCutOffIsRefused) {
  expect_only_whole("a.jpg",
                    encoded(pattern(), ".jpg", {cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 2}), 2);
}

// A segment of the metadata, right after the first marker.
std::string with_metadata(const std::string& jpeg, const std::string& metadata) {
  const std::size_t length = metadata.size() + 2;
  return jpeg.substr(0, 2) + "\xFF\xE1" + static_cast<char>(length >> 8U) + static_cast<char>(length & 0xFFU) +
         metadata + jpeg.substr(2);
}

TEST(DatasetImage, TheEndOfAThumbnailIsNotTheEndOfAJpeg) {
  const std::string thumbnail = encoded(cv::Mat(8, 8, CV_8UC3, cv::Scalar(1, 2, 3)), ".jpg");
  expect_only_whole("a.jpg", with_metadata(encoded(picture(1, 0), ".jpg"), "Other" + thumbnail), 2);
}

TEST(DatasetImage, AnOrientationInTheMetadataIsIgnored) {
  // TIFF header, one entry: tag 0x112 (orientation), a 16-bit number, one of it, 6 (turned by a quarter)
  using std::string_literals::operator""s;
  const std::string exif = "Exif\0\0MM\0*\0\0\0\10\0\1\1\22\0\3\0\0\0\1\0\6\0\0\0\0\0\0"s;
  const std::string turned = with_metadata(encoded(picture(1, 0), ".jpg"), exif);
  const cv::Mat obeyed = cv::imdecode(std::vector<char>(turned.begin(), turned.end()), cv::IMREAD_COLOR);
  ASSERT_EQ(obeyed.cols, 24);  // the test's own metadata is understood
  const TemporaryFolder folder;
  write_single(folder, "a.jpg", turned);
  EXPECT_EQ(read_single(folder).frames[0].view.width, 32);
}

TEST(DatasetImage, EveryKindOfPngBecomesBgr8) {
  const TemporaryFolder folder;
  const auto read = [&](const cv::Mat& image) {
    write_single(folder, "a.png", encoded(image, ".png"));
    const FrameSet set = read_single(folder);
    EXPECT_EQ(set.frames[0].view.format, PixelFormat::bgr8);
    return pixel(set.frames[0].view, 11, 13);
  };
  EXPECT_EQ(read(cv::Mat(24, 32, CV_8UC1, cv::Scalar(77))), (std::vector<int>{77, 77, 77}));
  EXPECT_EQ(read(cv::Mat(24, 32, CV_8UC4, cv::Scalar(10, 20, 30, 0))), (std::vector<int>{10, 20, 30}));
  EXPECT_EQ(read(cv::Mat(24, 32, CV_16UC3, cv::Scalar(0x1040, 0x2080, 0x30F0))), (std::vector<int>{0x10, 0x20, 0x30}));
  EXPECT_EQ(read(cv::Mat(24, 32, CV_16UC1, cv::Scalar(0x4DFF))), (std::vector<int>{0x4D, 0x4D, 0x4D}));
}

TEST(DatasetSource, ReadsTheRenderedNearSets) {
  const auto folder = test::shared_data() / "pov" / "near";
  MOVIS_NEEDS_SHARED_DATA(folder);
  DatasetSource source(read_dataset(folder));
  source.open();
  FrameSet set;
  for (int i = 0; i < 16; ++i) {
    ASSERT_TRUE(source.acquire(set));
    EXPECT_EQ(set.index, i);
    EXPECT_NEAR(set.time_s, 0.1 * i, 1e-9);
    ASSERT_EQ(set.frames.size(), 3U);
    for (int k = 0; k < 3; ++k) {
      const cv::Mat& image = set.memory[static_cast<std::size_t>(k)];
      const cv::Mat expected = cv::imread((folder / "images" / cv::format("%06d_M%d.png", i, k + 1)).string());
      ASSERT_EQ(image.size(), cv::Size(640, 480));
      EXPECT_EQ(cv::norm(image, expected, cv::NORM_INF), 0.0);
      EXPECT_EQ(set.frames[static_cast<std::size_t>(k)].view.data, image.data);
    }
  }
  EXPECT_FALSE(source.acquire(set));
}

TEST(DatasetSource, ReadsJpegsOfRealCameras) {
  const auto images = test::shared_data() / "real" / "robocup-msl-frames";
  MOVIS_NEEDS_SHARED_DATA(images);
  const TemporaryFolder folder;
  folder.write("rig.yaml", rig_text({"fisheye"}, 608, 800));
  std::string table = "frame,time_s,fisheye\n";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(images)) {
    if (entry.path().extension() != ".jpg") continue;
    const auto relative = std::filesystem::relative(entry.path(), folder.path());
    table += std::to_string(count) + "," + std::to_string(count) + "," + relative.string() + "\n";
    ++count;
  }
  EXPECT_EQ(count, 48);
  folder.write("frames.csv", table);
  DatasetSource source(read_dataset(folder.path()));
  source.open();
  for (FrameSet set; source.acquire(set); --count) EXPECT_EQ(set.frames[0].view.height, 800);
  EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace movis::grab
