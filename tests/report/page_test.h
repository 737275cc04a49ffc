#pragma once

#include <gtest/gtest.h>
#include <regex.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/chromium.h"

// What the tests of all pages share.
namespace movis::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr auto kNone = std::string::npos;

// A picture of one grey pixel, which Chromium decodes: the smallest PNG.
inline const std::vector<std::uint8_t> kPixelPng = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
    0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
    0xda, 0x45, 0x08, 0x3b, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

inline std::string read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The JSON that a page draws.
inline nlohmann::json data_in(const std::string& html) {
  const std::string opening = R"(<script type="application/json" id="data">)";
  const auto begin = html.find(opening) + opening.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

inline int count(const std::string& text, const std::string& pattern) {
  regex_t regex;  // POSIX: std::regex recurses for every character, too deep for a page
  if (regcomp(&regex, pattern.c_str(), REG_EXTENDED) != 0) throw std::runtime_error("bad pattern: " + pattern);
  int matches = 0;
  regmatch_t match;
  for (const char* at = text.c_str(); regexec(&regex, at, 1, &match, 0) == 0; at += match.rm_eo) ++matches;
  regfree(&regex);
  return matches;
}

inline void expect_self_contained(const std::string& html) {
  EXPECT_EQ(count(html, R"((src|href|action)\s*=\s*["']?\s*(https?:|//|file:))"), 0);
  EXPECT_EQ(count(html, R"(@import|url\(\s*["']?(https?:|//)|<link |<base |<iframe)"), 0);
  EXPECT_NE(html.find("default-src 'none'"), kNone) << "the policy that forbids the browser any request";
  EXPECT_NE(html.find("Copyright (c) 2010-2016, Michael Bostock"), kNone) << "D3's licence asks for its notice";
  EXPECT_EQ(html.find("{{"), kNone) << "a part of the template was not filled in";
}

inline void expect_silent(const ChromiumRun& run) {
  for (const std::string& message : run.messages) ADD_FAILURE() << message;
}

inline void expect_drawn_with_numbers(const std::string& dom) {
  EXPECT_EQ(count(dom, R"RX((x|y|cx|cy|x1|y1|x2|y2|d|r|rx|ry|transform)="[^"]*(NaN|Infinity|undefined|null))RX"), 0);
}

}  // namespace movis::test
