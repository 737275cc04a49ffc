#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include "movis/core/output_file.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

using test::expect_error;
using test::TemporaryFolder;

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(OutputFile, AppearsOnlyWhenComplete) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "out.csv";
  {
    OutputFile output(file);
    output.stream() << "half";
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  EXPECT_EQ(entries(folder.path()), 0U);
  {
    OutputFile output(file);
    output.stream() << "whole";
    output.commit();
  }
  EXPECT_EQ(entries(folder.path()), 1U);
  EXPECT_EQ(std::filesystem::file_size(file), 5U);
}

TEST(OutputFile, WritesToAPipeAsItIs) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { std::getline(std::ifstream(pipe), received); });
  {
    OutputFile output(pipe);
    output.stream() << "whole\n";
    output.commit();
  }
  reader.join();
  EXPECT_EQ(received, "whole");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(OutputFile, FollowsALink) {
  const TemporaryFolder folder;
  const auto target = folder.write("target.csv", "old");
  std::filesystem::create_symlink(target, folder.path() / "link.csv");
  OutputFile output(folder.path() / "link.csv");
  output.stream() << "whole";
  output.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.csv"));
  EXPECT_EQ(std::filesystem::file_size(target), 5U);
}

TEST(OutputFile, RefusesAPlaceThatCannotBeWritten) {
  const TemporaryFolder folder;
  expect_error([&] { OutputFile output(folder.path() / "absent" / "out.csv"); }, {"absent", "does not exist"});
  expect_error([&] { OutputFile output(folder.path()); }, {"is a folder"});
}

}  // namespace
}  // namespace movis
