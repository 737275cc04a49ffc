#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace movis::test {

struct ChromiumRun {
  std::string dom;                    // the document after its scripts ran
  std::vector<std::string> messages;  // every line of the page's console; a page without errors has none
};

// Opens a page in headless Chromium, with its output in the folder `scratch`. Throws, and so fails the test, where
// Chromium is absent, does not end within a minute or fails: a script's error shows only among the messages.
inline ChromiumRun open_in_chromium(const std::filesystem::path& page, const std::filesystem::path& scratch) {
  if (std::system("command -v chromium >/dev/null && command -v timeout >/dev/null") != 0) {
    throw std::runtime_error("chromium is not installed, and this test opens its page in it: apt-get install chromium");
  }
  const std::filesystem::path dom = scratch / "chromium.dom";
  const std::filesystem::path log = scratch / "chromium.log";
  std::string profile = (std::filesystem::temp_directory_path() / "movis-chromium-XXXXXX").string();
  if (mkdtemp(profile.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
  const std::string command =
      "timeout 60 chromium --headless=new --no-sandbox --disable-gpu --disable-quic --no-first-run"
      " --disable-background-networking --disable-component-update --disable-sync --disable-dev-shm-usage"
      " --enable-logging=stderr --window-size=1400,1000 --user-data-dir='" +
      profile + "' --dump-dom 'file://" + std::filesystem::absolute(page).string() + "' >'" + dom.string() + "' 2>'" +
      log.string() + "'";
  const int status = std::system(command.c_str());
  std::error_code ignored;  // a helper process of Chromium may still be leaving
  std::filesystem::remove_all(profile, ignored);
  if (status != 0) {
    throw std::runtime_error("chromium failed or took longer than a minute (wait status " + std::to_string(status) +
                             "): " + command);
  }
  ChromiumRun run;
  std::ifstream dom_file(dom, std::ios::binary);
  run.dom.assign(std::istreambuf_iterator<char>(dom_file), {});
  std::ifstream log_file(log);
  for (std::string line; std::getline(log_file, line);) {
    if (line.find("CONSOLE") != std::string::npos) run.messages.push_back(line);
  }
  return run;
}

}  // namespace movis::test
