// SPDX-License-Identifier: Apache-2.0
#include "pairing/pair_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/outside_json.hpp"
#include "pairing/armour.hpp"
#include "pairing/certificates.hpp"
#include "pairing/permissions.hpp"
#include "pairing/secret_files.hpp"

namespace telehug {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr std::int64_t last_time = 253'402'300'799;  // the end of the year 9999

// Nothing if it is absent or no time that a calendar knows.
std::optional<WallTime> time_in(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number_unsigned() || *found > last_time) return {};
  return WallTime(std::chrono::seconds(found->get<std::int64_t>()));
}

// What can't be read is for preflight to name.
WallTime first_end(const DdsSecurityFiles& files, WallTime end) {
  if (const auto certificate = read_certificate(read_secret(files.certificate)))
    end = std::min(end, validity_of(certificate.get()).until);
  if (const auto permitted = validity_in(read_secret(files.permissions))) end = std::min(end, permitted->until);
  return end;
}

}  // namespace

void keep_about(const Pair& pair) {
  const Json about = {{"version", 1},
                      {"id", pair.id},
                      {"name", pair.name},
                      {"phrase", pair.phrase},
                      {"expires", pair.expires.time_since_epoch().count()}};
  write_secret(folder_of(pair) / "pair.json", about.dump(2) + "\n");
}

std::optional<Pair> read_pair(const fs::path& folder, Side side) {
  const fs::path file = folder / "pair.json";
  std::error_code none;
  if (fs::status(file, none).type() == fs::file_type::not_found) return {};
  const Json about = parse_outside_json(read_secret(file));
  const std::string id = folder.filename().string();
  const auto expires = time_in(about, "expires");
  if (text_in(about, "id") != id || !expires) {
    throw std::runtime_error(
        fmt::format("{} is damaged or can't be read by this user: run as the user who made the pair, or `telehug pair "
                    "revoke {}` and "
                    "pair the two PCs again",
                    file.string(), id));
  }
  const DdsSecurityFiles files = files_in(folder);
  return Pair{
      id, text_in(about, "name"), side, partition_of(id), first_end(files, *expires), text_in(about, "phrase"), files};
}

Pair present(const Pair& pair) {
  try {
    return read_pair(folder_of(pair), pair.side).value_or(pair);
  } catch (const std::runtime_error&) {
    return pair;
  }
}

}  // namespace telehug
