#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace movis::fuzzy {

// A line `key: value` of an FLL file, without comments and outer blanks, its inner blanks made single spaces.
struct FllLine {
  std::string key;
  std::string value;
  int number = 0;
};

// A block of an FLL file: the line that opens it and its lines. Whoever reads a value that is not as it must be gets an
// Error that names file and line and says what was expected.
struct FllBlock {
  std::filesystem::path file;
  FllLine head;  // e.g. InputVariable: ball_gap
  std::vector<FllLine> lines;

  // Only these keys may stand here, and only those of `repeated` more than once.
  void allow(std::initializer_list<const char*> keys, std::initializer_list<const char*> repeated) const;

  const FllLine* find(const char* key) const;
  const FllLine& require(const char* key) const;
  std::vector<const FllLine*> all(const char* key) const;  // at least one

  std::string text(const char* key) const;  // empty where the key is not there
  bool flag(const char* key, bool otherwise) const;
  double number(const char* key) const;  // may be nan
  std::size_t one_of(const char* key, std::initializer_list<const char*> words, std::size_t otherwise) const;

  [[noreturn]] void fail(const FllLine& line, const std::string& what) const;
};

std::vector<FllBlock> split_fll(std::string_view text, const std::filesystem::path& file);

std::vector<std::string> words_of(std::string_view text);

// Reads all of the text as a number in the C locale's notation.
bool read_number(std::string_view text, double& number);

// Letters, digits, underscores and points, not beginning with a digit, and no word of the language.
bool is_name(std::string_view text);

}  // namespace movis::fuzzy
