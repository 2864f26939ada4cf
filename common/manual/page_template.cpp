// SPDX-License-Identifier: Apache-2.0
#include "manual/page_template.hpp"

#include <stdexcept>

#include "cli/roff.hpp"
#include "common/version.hpp"
#include "service/exit_code_text.hpp"

namespace telehug {
namespace {

std::string meaning(std::string_view word, std::string_view date) {
  if (word == "DATE") return std::string(date);
  if (word == "VERSION") return version;
  if (word == "EXIT_STATUS") return roff_exit_status({all_exit_codes.begin(), all_exit_codes.end()});
  throw std::runtime_error("a page of the manual has @" + std::string(word) + "@, which stands for nothing");
}

}  // namespace

std::string filled_page(std::string text, std::string_view date) {
  std::string out;
  for (;;) {
    const std::size_t open = text.find('@');
    const std::size_t close = open == std::string::npos ? open : text.find('@', open + 1);
    out += text.substr(0, open);
    if (open == std::string::npos) return out;
    if (close == std::string::npos) throw std::runtime_error("a page of the manual has a lone @");
    out += meaning(std::string_view(text).substr(open + 1, close - open - 1), date);
    text.erase(0, close + 1);
  }
}

}  // namespace telehug
