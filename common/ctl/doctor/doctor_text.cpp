// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/doctor_text.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "ctl/plain_text.hpp"

namespace telehug {
namespace {

const char* word(Level level) {
  return level == Level::ok ? "ok" : level == Level::warn ? "warn" : "fail";
}

}  // namespace

bool anything_fails(const Findings& findings) {
  return std::ranges::any_of(findings, [](const Finding& finding) { return finding.level == Level::fail; });
}

std::string doctor_text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += fmt::format("{:<5} {:<13} {}\n", word(finding.level), finding.check, plain_text(finding.what));
    if (!finding.fix.empty()) text += fmt::format("{:<19} -> {}\n", "", plain_text(finding.fix));
  }
  return text;
}

nlohmann::json doctor_json(const Findings& findings) {
  nlohmann::json all = nlohmann::json::array();
  for (const Finding& finding : findings)
    all.push_back(
        {{"check", finding.check}, {"level", word(finding.level)}, {"what", finding.what}, {"fix", finding.fix}});
  return {{"findings", all}};
}

}  // namespace telehug
