#include <gtest/gtest.h>

#include "movis/grab/dataset.h"
#include "support/temporary_folder.h"
#include "tiny_dataset.h"

namespace movis::grab {
namespace {

using test::expect_error;
using test::TemporaryFolder;

// A folder with a rig of the cameras M1 and M2 and the given frames.csv; no images.
class Tables {
 public:
  explicit Tables(const std::string& frames) {
    folder_.write("rig.yaml", rig_text({"M1", "M2"}));
    folder_.write("frames.csv", frames);
  }
  const TemporaryFolder& folder() const { return folder_; }
  Dataset read() const { return read_dataset(folder_.path()); }

 private:
  TemporaryFolder folder_;
};

void expect_refused(const std::string& frames, std::initializer_list<const char*> parts) {
  const Tables tables(frames);
  expect_error([&] { tables.read(); }, parts);
}

TEST(Dataset, ReadsRowsWithColumnsInAnyOrder) {
  const Tables tables(
      "M2,time_s,M1_time_s,M1,frame\n"
      "b0.png,0.5,0.51,images/a0.png,7\n"
      "../elsewhere/b1.png,0.25,,,3\n"
      "\n"
      ",-1,2.5,,9\n");
  const Dataset dataset = tables.read();
  const std::filesystem::path folder = tables.folder().path();
  EXPECT_EQ(dataset.folder, folder);
  ASSERT_EQ(dataset.rig.cameras.size(), 2U);
  ASSERT_EQ(dataset.frames.size(), 3U);

  const DatasetFrame& first = dataset.frames[0];
  EXPECT_EQ(first.line, 2);
  EXPECT_EQ(first.index, 7);
  EXPECT_DOUBLE_EQ(first.time_s, 0.5);
  ASSERT_EQ(first.images.size(), 2U);
  EXPECT_EQ(first.images[0].file, folder / "images/a0.png");
  EXPECT_DOUBLE_EQ(first.images[0].time_s, 0.51);
  EXPECT_EQ(first.images[1].file, folder / "b0.png");
  EXPECT_DOUBLE_EQ(first.images[1].time_s, 0.5);

  const DatasetFrame& one_lost = dataset.frames[1];
  EXPECT_EQ(one_lost.index, 3);
  EXPECT_TRUE(one_lost.images[0].file.empty());
  EXPECT_DOUBLE_EQ(one_lost.images[0].time_s, 0.25);
  EXPECT_EQ(one_lost.images[1].file, folder / "../elsewhere/b1.png");

  const DatasetFrame& all_lost = dataset.frames[2];
  EXPECT_EQ(all_lost.line, 5);
  EXPECT_DOUBLE_EQ(all_lost.images[0].time_s, 2.5);
  EXPECT_TRUE(all_lost.images[0].file.empty());
  EXPECT_TRUE(all_lost.images[1].file.empty());
}

TEST(Dataset, NamesTheFieldOnlyWhereThereIsOne) {
  const Tables tables("frame,time_s,M1,M2\n0,0,,\n");
  EXPECT_FALSE(tables.read().field_file);
  tables.folder().write("field.yaml", "");
  EXPECT_EQ(tables.read().field_file, tables.folder().path() / "field.yaml");
}

TEST(Dataset, AnotherRigTakesThePlaceOfItsOwn) {
  const Tables tables("frame,time_s,M1,M2\n0,0,a.png,\n");
  std::filesystem::remove(tables.folder().path() / "rig.yaml");
  const auto turned = tables.folder().write("turned.yaml", rig_text({"M2", "M1"}, 64, 48));
  const Dataset dataset = read_dataset(tables.folder().path(), turned);
  EXPECT_EQ(dataset.rig_file, turned);
  EXPECT_EQ(dataset.rig.cameras[0].width, 64);
  EXPECT_TRUE(dataset.frames[0].images[0].file.empty());
  EXPECT_EQ(dataset.frames[0].images[1].file, tables.folder().path() / "a.png");

  const auto other = tables.folder().write("other.yaml", rig_text({"M1", "left"}));
  expect_error([&] { read_dataset(tables.folder().path(), other); },
               {"frames.csv:1", "'left' is missing", "other.yaml", "M1, left"});
}

TEST(Dataset, AFolderThatIsNoDataSetSaysWhatOneIs) {
  const TemporaryFolder folder;
  const auto reading = [&](const std::string& name) { return [&folder, name] { read_dataset(folder.path() / name); }; };
  const char* explanation = "A data set is a folder with rig.yaml, frames.csv";
  folder.write("file", "");
  expect_error(reading("absent"), {"absent: does not exist", explanation});
  expect_error(reading("file"), {"file: is not a folder", explanation});
  folder.write("no_frames/rig.yaml", rig_text({"M1"}));
  expect_error(reading("no_frames"), {"no_frames: is not a data set: frames.csv is missing", explanation});
  folder.write("no_rig/frames.csv", "frame,time_s,M1\n0,0,\n");
  expect_error(reading("no_rig"), {"no_rig: is not a data set: rig.yaml is missing", explanation});
}

TEST(Dataset, TheColumnsAreThoseOfTheRig) {
  expect_refused("frame,time_s,M1,M2,M3\n0,0,,,\n", {"frames.csv:1", "unknown column 'M3'", "rig.yaml", "M1, M2"});
  expect_refused("frame,time_s,M1,M2,M3_time_s\n0,0,,,1\n", {"frames.csv:1", "unknown column 'M3_time_s'"});
  expect_refused("frame,time_s,M1\n0,0,\n", {"frames.csv:1", "column 'M2' is missing", "rig.yaml", "M1, M2", "Add it"});
  expect_refused("time_s,M1,M2\n0,,\n", {"frames.csv:1", "'frame' is missing"});
  expect_refused("frame,M1,M2\n0,,\n", {"frames.csv:1", "'time_s' is missing"});
  expect_refused("frame,time_s,M1,M2,M1\n0,0,,,\n", {"frames.csv:1", "twice"});
}

TEST(Dataset, AnEmptyTableIsRefused) {
  expect_refused("", {"frames.csv", "is empty"});
  expect_refused("\n\n", {"frames.csv", "is empty"});
  expect_refused("frame,time_s,M1,M2\n", {"frames.csv", "no frame"});
}

TEST(Dataset, ErrorsNameFileLineAndColumn) {
  const std::string header = "frame,time_s,M1,M2,M2_time_s\n0,0,a.png,b.png,0\n";
  expect_refused(header + "1,0,a.png\n", {"frames.csv:3", "3 cells"});
  expect_refused(header + "one,0,,,\n", {"frames.csv:3", "'frame'", "'one'", "whole number"});
  expect_refused(header + "1.5,0,,,\n", {"frames.csv:3", "'frame'", "whole number"});
  expect_refused(header + "1,,,,\n", {"frames.csv:3", "'time_s'", "number"});
  expect_refused(header + "1,nan,,,\n", {"frames.csv:3", "'time_s'", "'nan'", "finite"});
  expect_refused(header + "1,0,,b.png,soon\n", {"frames.csv:3", "'M2_time_s'", "'soon'"});
  expect_refused(header + "1,0,,b.png,\n", {"frames.csv:3", "'M2_time_s'", "number"});
  expect_refused(header + "1,0,,,soon\n", {"frames.csv:3", "'M2_time_s'", "'soon'"});
  expect_refused(header + "1,0,,/b.png,0\n", {"frames.csv:3", "'M2'", "'/b.png'", "absolute", "relative"});
}

TEST(Dataset, AFrameNumberStandsOnce) {
  expect_refused("frame,time_s,M1,M2\n4,0,,\n5,1,,\n4,2,,\n", {"frames.csv:4", "'frame'", "4", "line 2"});
}

TEST(Dataset, AnImageThatIsNotThereIsNamedWithItsCell) {
  const TinyDataset tiny(3);
  EXPECT_NO_THROW(check_images(read_dataset(tiny.path())));
  const auto image = tiny.path() / "images/2_M2.png";
  std::filesystem::remove(image);
  expect_error([&] { check_images(read_dataset(tiny.path())); },
               {"frames.csv:4", "'M2'", image.c_str(), "correct the path", "leave the cell empty"});
  std::filesystem::create_directory(image);
  expect_error([&] { check_images(read_dataset(tiny.path())); }, {"frames.csv:4", "'M2'", image.c_str()});
}

}  // namespace
}  // namespace movis::grab
