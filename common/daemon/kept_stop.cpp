// SPDX-License-Identifier: Apache-2.0
#include "daemon/kept_stop.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "common/outside_json.hpp"
#include "files/private_file.hpp"
#include "files/text_file.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr int format = 1;

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::symlink_status(file, ignored).type() != fs::file_type::not_found;
}

Status remove_file(const fs::path& file) {
  std::error_code problem;
  if (!is_there(file) || fs::remove(file, problem)) return Done{};
  return Error{
      fmt::format("{} can't be removed ({}); see who may write to its folder", file.string(), problem.message())};
}

}  // namespace

Result<std::string> parse_kept_stop(std::string_view text) {
  const Json json = parse_outside_json(text);
  const bool whole = json.is_object() && json.size() == 2 && json.contains("format") && json.at("format") == format &&
                     json.contains("reason") && json.at("reason").is_string();
  if (!whole) return Error{"is damaged: it is none that this version of telehug has written"};
  return json.at("reason").get<std::string>();
}

Result<std::optional<std::string>> read_kept_stop(const fs::path& file) {
  if (!is_there(file)) return std::optional<std::string>{};
  const auto text = read_text_file(file);
  if (!text) return text.error();
  auto reason = parse_kept_stop(*text);
  if (!reason) return reason.error();
  return std::optional(*std::move(reason));
}

Status keep_stop(const fs::path& file, const std::optional<std::string>& reason) {
  if (!reason) return remove_file(file);
  std::error_code ignored;  // writing says what is wrong
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
  const Json json{{"format", format}, {"reason", *reason}};
  return keep_private_file(file, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace telehug
