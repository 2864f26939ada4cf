// SPDX-License-Identifier: Apache-2.0
#include "cli/roff.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

#include "common/version.hpp"
#include "service/exit_code_text.hpp"

namespace telehug {

std::string roff(std::string_view text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    line_begins = c == '\n';
    switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string roff_argument(std::string_view text) {
  std::string out;
  for (const char c : roff(text))
    out += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return '"' + out + '"';
}

std::string roff_example(std::string_view text) {
  std::string lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);)
    lines += roff(line) + '\n';
  return ".PP\n.RS 2\n.nf\n" + lines + ".fi\n.RE\n";
}

std::string roff_item(std::string_view tag, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", roff_argument(tag), roff(text));
}

std::string roff_title(std::string_view name, int section, std::string_view date) {
  std::string upper(name);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  return fmt::format(".TH {} {} \"{}\" {} telehug\n", roff_argument(upper), section, date,
                     roff_argument(fmt::format("telehug {}", version)));
}

std::string roff_exit_status(const std::vector<ExitCode>& codes) {
  std::string text;
  for (const ExitCode code : codes)
    text += roff_item(fmt::format("{}", to_int(code)), exit_code_text(code));
  return text;
}

}  // namespace telehug
