#include "fll_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "movis/core/error.h"
#include "movis/core/names.h"

namespace movis::fuzzy {
namespace {

constexpr const char* kBlanks = " \t\r\f\v";

std::string with_single_spaces(std::string_view text) {
  return fmt::format("{}", fmt::join(words_of(text), " "));
}

bool opens_block(const std::string& key) {
  return key == "Engine" || key == "InputVariable" || key == "OutputVariable" || key == "RuleBlock";
}

bool contains(std::initializer_list<const char*> words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

void FllBlock::allow(std::initializer_list<const char*> keys, std::initializer_list<const char*> repeated) const {
  for (const FllLine& line : lines) {
    if (contains(repeated, line.key)) continue;
    if (!contains(keys, line.key)) {
      std::vector<std::string> known(keys.begin(), keys.end());
      known.insert(known.end(), repeated.begin(), repeated.end());
      fail(line, fmt::format("unknown key '{}' in {}{}", line.key, head.key, suggestion(line.key, known)));
    }
    if (find(line.key.c_str()) != &line) {
      fail(line, fmt::format("key '{}' stands twice in this {}", line.key, head.key));
    }
  }
}

const FllLine* FllBlock::find(const char* key) const {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const FllLine& line) { return line.key == key; });
  return found == lines.end() ? nullptr : &*found;
}

const FllLine& FllBlock::require(const char* key) const {
  const FllLine* line = find(key);
  if (line == nullptr) fail(head, fmt::format("'{}: {}' has no line '{}:'", head.key, head.value, key));
  return *line;
}

std::vector<const FllLine*> FllBlock::all(const char* key) const {
  require(key);
  std::vector<const FllLine*> found;
  for (const FllLine& line : lines) {
    if (line.key == key) found.push_back(&line);
  }
  return found;
}

std::string FllBlock::text(const char* key) const {
  const FllLine* line = find(key);
  return line == nullptr ? "" : line->value;
}

bool FllBlock::flag(const char* key, bool otherwise) const {
  return one_of(key, {"false", "true"}, otherwise ? 1 : 0) == 1;
}

double FllBlock::number(const char* key) const {
  const FllLine& line = require(key);
  double value = 0.0;
  if (!read_number(line.value, value)) fail(line, fmt::format("'{}' is '{}'; it must be a number", key, line.value));
  return value;
}

std::size_t FllBlock::one_of(const char* key, std::initializer_list<const char*> words, std::size_t otherwise) const {
  const FllLine* line = find(key);
  if (line == nullptr) return otherwise;
  const auto found = std::find(words.begin(), words.end(), line->value);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  fail(*line, fmt::format("'{}' is '{}'; it must be one of: {}", key, line->value,
                          fmt::join(words.begin(), words.end(), ", ")));
}

void FllBlock::fail(const FllLine& line, const std::string& what) const {
  throw Error("{}:{}: {}", file.string(), line.number, what);
}

std::vector<FllBlock> split_fll(std::string_view text, const std::filesystem::path& file) {
  std::vector<FllBlock> blocks;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view content = text.substr(0, end);
    text = end == std::string_view::npos ? "" : text.substr(end + 1);
    ++number;
    content = content.substr(0, content.find('#'));
    if (content.find_first_not_of(kBlanks) == std::string_view::npos) continue;

    const std::size_t colon = content.find(':');
    if (colon == std::string_view::npos) {
      throw Error("{}:{}: '{}' is no line 'key: value'", file.string(), number, with_single_spaces(content));
    }
    FllLine line{with_single_spaces(content.substr(0, colon)), with_single_spaces(content.substr(colon + 1)), number};
    if (opens_block(line.key)) {
      blocks.push_back({file, line, {}});
    } else if (blocks.empty()) {
      throw Error("{}:{}: '{}:' stands before any block; a rule base begins with 'Engine: NAME'", file.string(), number,
                  line.key);
    } else {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(kBlanks, begin)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

bool read_number(std::string_view text, double& number) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stopped == end;
}

bool is_name(std::string_view text) {
  constexpr std::array kReserved{"if",  "is",   "and",      "or",        "then",   "with",
                                 "not", "very", "somewhat", "extremely", "seldom", "any"};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto belongs = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '.'; };
  return !text.empty() && is_letter(text.front()) && std::all_of(text.begin(), text.end(), belongs) &&
         std::find(kReserved.begin(), kReserved.end(), text) == kReserved.end();
}

}  // namespace movis::fuzzy
