// SPDX-License-Identifier: Apache-2.0
#include "ctl/report/masker.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <utility>

namespace telehug {
namespace {

// std::regex recurses with every letter: longer lines are cut.
constexpr std::size_t longest_line = 2000;

bool is_letter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80;
}

// Where `part` stands as words of its own.
bool stands_alone(const std::string& line, std::size_t at, std::size_t length) {
  const std::size_t end = at + length;
  return (at == 0 || !is_letter(line[at - 1]) || !is_letter(line[at])) &&
         (end >= line.size() || !is_letter(line[end]) || !is_letter(line[end - 1]));
}

void replace_words(std::string& line, const std::string& secret, const std::string& word) {
  for (std::size_t at = line.find(secret); at != std::string::npos; at = line.find(secret, at)) {
    if (!stands_alone(line, at, secret.size())) {
      ++at;
      continue;
    }
    line.replace(at, secret.size(), word);
    at += word.size();
  }
}

using Rule = std::pair<std::regex, const char*>;

const auto& rules() {
  static const std::array<Rule, 12> all{{
      {std::regex("TELEHUG:PAIR:[^\\s\"]+"), "[code]"},
      // Pairing codes: eight groups of five (Crockford's base 32).
      {std::regex("\\b([0-9A-Za-z]{5}[- ]){7}[0-9A-Za-z]{5}\\b"), "[code]"},
      {std::regex("link=[^\\s\"&]+"), "link=[link]"},
      {std::regex("/by-(id|path)/[^\\s\",;]+"), "/by-$1/[device]"},
      {std::regex("/home/[^/\\s\",;:]+"), "/home/[user]"},
      {std::regex("[A-Za-z0-9._%+-]+@[A-Za-z0-9-]+(\\.[A-Za-z0-9-]+)+"), "[e-mail]"},
      {std::regex("([0-9A-Fa-f]{2}[:_-]){5}[0-9A-Fa-f]{2}"), "[device address]"},
      {std::regex("\\b(?!127\\.|0\\.0\\.0\\.0\\b)\\d{1,3}(\\.\\d{1,3}){3}\\b"), "[address]"},
      {std::regex("\\b[0-9A-Fa-f]{1,4}(:[0-9A-Fa-f]{0,4}){3,7}"), "[address]"},
      // Short IPv6 has "::", and a digit or the prefix of a local address: not C++'s scopes, whatever their letters.
      {std::regex(
           "\\b(?=[0-9A-Fa-f:]*[0-9]|(?:fe[89ab]|f[cd][0-9a-f])[0-9a-f]:)[0-9A-Fa-f]{1,4}(?::[0-9A-Fa-f]{1,4})*::"
           "(?:[0-9A-Fa-f]{1,4}(?::[0-9A-Fa-f]{1,4})*)?(?![0-9A-Za-z_:])"),
       "[address]"},
      {std::regex("\\b[0-9a-f]{16,}\\b"), "[id]"},
      {std::regex("[A-Za-z0-9+/]{40,}={0,2}"), "[key]"},
  }};
  return all;
}

// Where a message begins: behind the journal's "telehug-passive[7]: ", a log file's level, or doctor's daemon.
std::size_t message_at(const std::string& line) {
  static const std::regex front(
      "^.*?(?:\\[\\d+\\]: |\\b(?:trace|debug|info|warning|error):? +|\\btelehug-(?:active|passive): )");
  std::smatch found;
  return std::regex_search(line, found, front) ? static_cast<std::size_t>(found.length()) : 0;
}

// For a whole message, without what is before it.
const auto& message_rules() {
  static const std::array<Rule, 4> all{{
      // Both: when the second is said tells as much as the first.
      {std::regex("^(?:.+: nothing is felt|touches may be felt)$"), "[text]"},
      {std::regex("^.+: (no peer is connected)"), "[name]: $1"},
      {std::regex("^(?!.*\\b(?:the other PC|the other side|no peer|a peer|when it) is connected).+ is connected$"),
       "[name] is connected"},
      {std::regex("^.+ hugs you"), "[name] hugs you"},
  }};
  return all;
}

const auto& free_text_rules() {
  static const std::array<Rule, 8> all{{
      {std::regex("\"[^\"]*\""), "\"[text]\""},
      {std::regex("(stopped(?: here| everything)?: ).*"), "$1[text]"},
      {std::regex("(is stopped: |is not ready: ).*"), "$1[text]"},
      {std::regex("(quiet hours: ).*"), "$1[text]"},
      {std::regex("(touch \\d+ (?:begins|ends) in box ).*"), "$1[text]"},
      {std::regex("(paired with ).*( until)"), "$1[name]$2"},
      {std::regex("(the pair with ).*( \\([^()]*\\) (?:can't be|is valid)| (?:is|was) renewed until| was revoked on|"
                  " has expired on| ends on)"),
       "$1[name]$2"},
      // In whatever other sentence: what the name's end is nobody knows.
      {std::regex("(the pair with )(?!\\[name\\]).*"), "$1[name]"},
  }};
  return all;
}

}  // namespace

void Masker::hide(std::string_view secret, std::string word) {
  constexpr std::array<std::string_view, 3> of_every_pc{"root", "telehug", "localhost"};
  if (secret.size() < 2 || std::ranges::find(of_every_pc, secret) != of_every_pc.end()) return;
  hidden_.emplace(secret, "[" + std::move(word) + "]");
}

std::string Masker::mask_line(std::string line, bool free_text) const {
  if (line.size() > longest_line) line = line.substr(0, longest_line) + " [cut]";
  for (const auto& [secret, word] : hidden_)
    replace_words(line, secret, word);
  for (const auto& [pattern, word] : rules())
    line = std::regex_replace(line, pattern, word);
  if (!free_text) return line;
  for (const auto& [pattern, word] : free_text_rules())
    line = std::regex_replace(line, pattern, word);
  const std::size_t begin = message_at(line);
  std::string message = line.substr(begin);
  for (const auto& [pattern, word] : message_rules())
    message = std::regex_replace(message, pattern, word);
  return line.substr(0, begin) + message;
}

std::string Masker::mask_lines(std::string_view text, bool free_text) const {
  std::string masked;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    masked += mask_line(std::string(text.substr(at, end - at)), free_text) + "\n";
    at = end + 1;
  }
  if (!text.ends_with('\n') && !masked.empty()) masked.pop_back();
  return masked;
}

std::string Masker::mask(std::string_view text) const {
  return mask_lines(text, false);
}

std::string Masker::mask_free_text(std::string_view text) const {
  return mask_lines(text, true);
}

}  // namespace telehug
