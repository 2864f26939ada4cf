// SPDX-License-Identifier: Apache-2.0
//
// What comes from the other person by chat or file: any text; any JSON in the right armour; and a real request and a
// real answer that somebody changed on the way. Nothing but an error or a pair that can be used may come of it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "doubles/temporary_folder.hpp"
#include "fuzz/bytes.hpp"
#include "fuzz/edits.hpp"
#include "pairing/armour.hpp"
#include "pairing/pairing.hpp"

namespace telehug {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const WallTime now{std::chrono::seconds(1'800'000'000)};
constexpr std::size_t most_edits = 6;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// One parent's PC that has asked and one wearer's PC that has answered, before and after every input.
class TwoPcs {
 public:
  TwoPcs() {
    request_ = parent_.request("Grandma").value();
    key_ = content(pending());
    const auto granted = wearer_.grant(request_, "Mia", now).value();
    grant_ = granted.grant;
    phrase_ = granted.pair.phrase;
    authorities_ = content(granted.pair.files.identity_ca) + content(granted.pair.files.permissions_ca);
    wearer_.revoke(granted.pair.id);
  }

  [[nodiscard]] const std::string& request() const { return request_; }
  [[nodiscard]] const std::string& grant() const { return grant_; }

  void wearer_reads(const std::string& request) {
    const auto granted = wearer_.grant(request, "Mia", now);
    require(wearer_.list().size() == (granted ? 1 : 0));
    if (!granted) return require(!granted.error().message.empty());
    parent_reads(granted->grant);
    wearer_.revoke(granted->pair.id);
  }

  void parent_reads(const std::string& grant) {
    const auto pair = parent_.accept(grant, now);
    if (pair) {
      require(parent_.list().size() == 1 && !fs::exists(pending()));
      // Whom the parent trusts is in the words that the two people compare.
      const bool same = content(pair->files.identity_ca) + content(pair->files.permissions_ca) == authorities_;
      require(same || pair->phrase != phrase_);
      parent_.revoke(pair->id);
      std::ofstream(pending(), std::ios::binary) << key_;
    } else {
      require(!pair.error().message.empty() && parent_.list().empty());
    }
    // Nothing lies about, and the parent can be answered again.
    require(content(pending()) == key_);
    // The pending key and, until it is used, its end of a tunnel.
    require(std::distance(fs::directory_iterator(folder_ / "parent"), {}) <= 2);
  }

 private:
  [[nodiscard]] fs::path pending() const { return folder_ / "parent" / "pending.key"; }

  TemporaryFolder folder_;
  PairStore parent_{folder_ / "parent", Side::active};
  PairStore wearer_{folder_ / "wearer", Side::passive};
  std::string request_;
  std::string grant_;
  std::string key_;
  std::string phrase_;
  std::string authorities_;
};

void give(TwoPcs& pcs, const std::string& kind, const std::string& text) {
  kind == "request" ? pcs.wearer_reads(text) : pcs.parent_reads(text);
}

// What has come through once comes through again as the same.
void read(TwoPcs& pcs, const std::string& kind, const std::string& text) {
  const auto json = unarmour(kind, text);
  if (json) require(unarmour(kind, armour(kind, *json)).value() == *json);
  give(pcs, kind, text);
}

std::string valid_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json changed(Json json, Bytes& bytes) {
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items())
    names.push_back(name);
  for (int i = 0; i < 3 && !bytes.empty(); ++i) {
    Json& field = json[names[bytes.byte() % names.size()]];
    const Json& other = json[names[bytes.byte() % names.size()]];
    const std::string text = field.is_string() ? field.get<std::string>() : "";
    switch (bytes.byte() % 6) {
      case 0:
        field = valid_utf8(edited(text, bytes, most_edits));
        break;
      case 1:
        field = edited_within_base64(text, bytes, most_edits);
        break;
      case 2:
        field = Json(other);
        break;
      case 3:
        if (other.is_string()) field = text + other.get<std::string>();
        break;
      case 4:
        field = Json::parse(bytes.text(bytes.byte()), nullptr, false);
        if (field.is_discarded()) field = nullptr;
        break;
      default:
        field = nullptr;
        break;
    }
  }
  return json;
}

}  // namespace
}  // namespace telehug

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace telehug;
  static TwoPcs pcs;
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  const std::string kind = (how & 1U) != 0 ? "request" : "grant";
  const std::string& real = kind == "request" ? pcs.request() : pcs.grant();
  switch (how / 2 % 4) {
    case 0:
      read(pcs, kind, bytes.rest());
      break;
    case 1: {
      auto json = Json::parse(bytes.rest(), nullptr, false);
      if (json.is_object() && json.dump().size() < max_armoured_size / 2) read(pcs, kind, armour(kind, json));
      break;
    }
    case 2:
      read(pcs, kind, edited(real, bytes, most_edits));
      break;
    default:
      read(pcs, kind, armour(kind, changed(unarmour(kind, real).value(), bytes)));
      break;
  }
  return 0;
}
