// SPDX-License-Identifier: Apache-2.0
//
// Prints pages of the manual that no program prints of itself:
//   telehug_manual_page config active|passive DATE
//   telehug_manual_page page TEMPLATE DATE
#include <cstdio>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "manual/config_page.hpp"
#include "manual/page_template.hpp"

namespace {

std::string content_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (!stream) throw std::runtime_error(file + " can't be read");
  return content.str();
}

std::string page(const std::string& kind, const std::string& which, const std::string& date) {
  if (kind == "config" && which == "active") return telehug::config_page(telehug::Side::active, date);
  if (kind == "config" && which == "passive") return telehug::config_page(telehug::Side::passive, date);
  if (kind == "page") return telehug::filled_page(content_of(which), date);
  throw std::runtime_error("usage: telehug_manual_page config active|passive DATE, or page TEMPLATE DATE");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw std::runtime_error("three arguments are needed");
    return std::fputs(page(argv[1], argv[2], argv[3]).c_str(), stdout) < 0 ? 1 : 0;
  } catch (const std::exception& problem) {
    (void)std::fprintf(stderr, "telehug_manual_page: %s\n", problem.what());
    return 1;
  }
}
