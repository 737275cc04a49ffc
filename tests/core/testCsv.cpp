#include <gtest/gtest.h>

#include "movis/core/csv.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

using test::expect_error;
using test::TemporaryFolder;

TEST(Csv, ReadsCellsAndKeepsEmptyOnes) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::read(folder.write("t.csv", "frame, time_s,M1\r\n0,0.5,a.png\r\n\n7, 1e-1,\n"));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.integer(1, table.column("frame")), 7);
  EXPECT_DOUBLE_EQ(table.number(1, table.column("time_s")), 0.1);
  EXPECT_EQ(table.text(0, table.column("M1")), "a.png");
  EXPECT_EQ(table.text(1, table.column("M1")), "");
  EXPECT_EQ(table.line(1), 4);
}

TEST(Csv, ByteOrderMarkAndLargeNumbers) {
  const TemporaryFolder folder;
  const CsvTable table = CsvTable::read(folder.write("t.csv",
                                                     "\xEF\xBB\xBF"
                                                     "frame\n3000000000\n"));
  EXPECT_EQ(table.integer(0, table.column("frame")), 3000000000);
}

TEST(Csv, ErrorsNameFileLineAndColumn) {
  const TemporaryFolder folder;
  expect_error([&] { CsvTable::read(folder.path() / "absent.csv"); }, {"absent.csv", "cannot be opened"});
  expect_error([&] { CsvTable::read(folder.write("t.csv", "")); }, {"t.csv", "is empty"});
  expect_error([&] { CsvTable::read(folder.write("t.csv", "a,b\n1,2\n1\n")); }, {"t.csv:3", "1 cells"});
  expect_error([&] { CsvTable::read(folder.write("t.csv", "a,a\n")); }, {"t.csv:1", "twice"});
  const CsvTable table = CsvTable::read(folder.write("t.csv", "a,b\n1,x\n1,inf\n"));
  expect_error([&] { (void)table.column("c"); }, {"t.csv:1", "'c'", "missing"});
  expect_error([&] { (void)table.number(0, 1); }, {"t.csv:2", "'b'", "'x'"});
  expect_error([&] { (void)table.number(1, 1); }, {"t.csv:3", "finite"});
}

}  // namespace
}  // namespace movis
