// SPDX-License-Identifier: Apache-2.0
#include "ctl/doctor/firewall.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace telehug {
namespace {

using Json = nlohmann::json;

enum class Match { no, unknown, yes };
enum class Verdict { go_on, accept, drop, leave };  // leave: back to the chain that jumped here

constexpr int deepest_jump = 16;  // as the kernel has it

Match inverse(Match match) {
  return match == Match::yes ? Match::no : match == Match::no ? Match::yes : Match::unknown;
}

std::string text(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

class Ruleset {
 public:
  Ruleset(const Json& ruleset, int port) : port_(port) {
    const auto list = ruleset.is_object() ? ruleset.find("nftables") : ruleset.end();
    if (ruleset.is_object() && list != ruleset.end() && list->is_array()) all_ = &*list;
  }

  FirewallVerdict judge() {
    if (all_ == nullptr) return FirewallVerdict::lets_some_in;
    for (const Json* chain : input_chains()) {
      Verdict verdict = run(*chain, 0);
      if (verdict == Verdict::go_on || verdict == Verdict::leave)
        verdict = text(*chain, "policy") == "drop" ? Verdict::drop : Verdict::accept;
      // An accept of one chain is an accept of this chain only.
      if (verdict == Verdict::drop) closing_ = chain;
      if (verdict == Verdict::drop)
        return perhaps_accepted_ ? FirewallVerdict::lets_some_in : FirewallVerdict::keeps_out;
    }
    return perhaps_dropped_ ? FirewallVerdict::lets_some_in : FirewallVerdict::lets_in;
  }

  // After judge(): the base chain that keeps it out.
  [[nodiscard]] std::optional<ClosingChain> closing() const {
    if (closing_ == nullptr) return std::nullopt;
    ClosingChain chain{text(*closing_, "family"), text(*closing_, "table"), text(*closing_, "name"), false};
    chain.of_ufw = std::ranges::any_of(*all_, [&](const Json& entry) {
      const auto other = entry.find("chain");
      return other != entry.end() && same_table(*other, *closing_) && text(*other, "name").starts_with("ufw-");
    });
    return chain;
  }

 private:
  [[nodiscard]] std::vector<const Json*> input_chains() const {
    std::vector<const Json*> chains;
    for (const Json& entry : *all_) {
      const auto chain = entry.find("chain");
      if (chain != entry.end() && text(*chain, "hook") == "input" && text(*chain, "type") == "filter" &&
          is_of_ipv4(*chain))
        chains.push_back(&*chain);
    }
    std::ranges::sort(chains, [](const Json* a, const Json* b) {
      const auto priority = [](const Json& chain) {
        const auto prio = chain.find("prio");
        return prio != chain.end() && prio->is_number_integer() ? prio->get<int>() : 0;
      };
      return priority(*a) < priority(*b);
    });
    return chains;
  }

  static bool is_of_ipv4(const Json& part) {
    const std::string family = text(part, "family");
    return family == "inet" || family == "ip";
  }

  static bool same_table(const Json& a, const Json& b) {
    return text(a, "family") == text(b, "family") && text(a, "table") == text(b, "table");
  }

  Verdict run(const Json& chain, int depth) {
    if (depth > deepest_jump) return Verdict::go_on;
    for (const Json& entry : *all_) {
      const auto rule = entry.find("rule");
      if (rule == entry.end() || !same_table(*rule, chain) || text(*rule, "chain") != text(chain, "name")) continue;
      const Verdict verdict = run_rule(*rule, depth);
      if (verdict != Verdict::go_on) return verdict;
    }
    return Verdict::go_on;
  }

  Verdict run_rule(const Json& rule, int depth) {
    Match match = Match::yes;
    const auto parts = rule.find("expr");
    if (parts == rule.end() || !parts->is_array()) return Verdict::go_on;
    for (const Json& part : *parts) {
      if (!part.is_object() || part.empty()) continue;
      const std::string& kind = part.begin().key();
      const Json& content = part.begin().value();
      if (kind == "match") {
        match = std::min(match, matches(rule, content));
      } else if (kind == "limit" || kind == "xt" || kind == "ct count") {
        match = std::min(match, Match::unknown);
      } else if (kind == "vmap") {
        return look_up(rule, content, match, depth);
      } else if (const Verdict verdict = decide(rule, kind, content, match, depth); verdict != Verdict::go_on) {
        return verdict;
      }
      if (match == Match::no) return Verdict::go_on;
    }
    return Verdict::go_on;
  }

  Verdict decide(const Json& rule, const std::string& kind, const Json& content, Match match, int depth) {
    Verdict verdict = Verdict::go_on;
    if (kind == "accept") verdict = Verdict::accept;
    if (kind == "drop" || kind == "reject") verdict = Verdict::drop;
    if (kind == "return") verdict = Verdict::leave;
    if (kind == "jump" || kind == "goto") {
      const Json* chain = find(rule, "chain", text(content, "target"));
      if (chain != nullptr) verdict = jump(*chain, match, depth);
      if (kind == "goto" && match == Match::yes && verdict == Verdict::go_on) verdict = Verdict::leave;
      return verdict;
    }
    if (match == Match::yes) return verdict;
    if (verdict == Verdict::accept) perhaps_accepted_ = true;
    if (verdict == Verdict::drop) perhaps_dropped_ = true;
    return Verdict::go_on;
  }

  Verdict jump(const Json& chain, Match match, int depth) {
    const Verdict verdict = run(chain, depth + 1);
    if (verdict == Verdict::leave) return Verdict::go_on;
    if (match == Match::yes) return verdict;
    if (verdict == Verdict::accept) perhaps_accepted_ = true;
    if (verdict == Verdict::drop) perhaps_dropped_ = true;
    return Verdict::go_on;
  }

  Verdict look_up(const Json& rule, const Json& vmap, Match match, int depth) {
    const Json data = vmap.value("data", Json());
    const Json* elements = elements_of(rule, data, "map");
    if (elements == nullptr) return Verdict::go_on;
    for (const Json& element : *elements) {
      if (!element.is_array() || element.size() != 2 || !element[1].is_object() || element[1].empty()) continue;
      const Match this_one = std::min(match, equals(rule, vmap.value("key", Json()), element[0]));
      if (this_one == Match::no) continue;
      const Verdict verdict = decide(rule, element[1].begin().key(), element[1].begin().value(), this_one, depth);
      if (verdict != Verdict::go_on) return verdict;
    }
    return Verdict::go_on;
  }

  const Json* find(const Json& beside, const char* kind, const std::string& name) const {
    for (const Json& entry : *all_) {
      const auto found = entry.find(kind);
      if (found != entry.end() && same_table(*found, beside) && text(*found, "name") == name) return &*found;
    }
    return nullptr;
  }

  // Of a set or map that is written there, or named "@name"; null if it is unknown.
  const Json* elements_of(const Json& rule, const Json& data, const char* kind) {
    if (data.is_object() && data.contains("set")) {
      scratch_.push_back(data["set"]);
      return scratch_.back().is_array() ? &scratch_.back() : nullptr;
    }
    if (!data.is_string() || !data.get_ref<const std::string&>().starts_with('@')) return nullptr;
    const Json* named = find(rule, kind, data.get<std::string>().substr(1));
    if (named == nullptr) return nullptr;
    scratch_.push_back(named->value("elem", Json::array()));
    return scratch_.back().is_array() ? &scratch_.back() : nullptr;
  }

  Match matches(const Json& rule, const Json& match) {
    const Match same = equals(rule, match.value("left", Json()), match.value("right", Json()));
    const std::string op = text(match, "op");
    if (op == "==" || op == "in") return same;
    return op == "!=" ? inverse(same) : Match::unknown;
  }

  Match equals(const Json& rule, const Json& left, const Json& right) {
    if (right.is_object() && right.contains("set")) return any_of(rule, left, right["set"]);
    if (right.is_string() && right.get_ref<const std::string&>().starts_with('@')) {
      const Json* elements = elements_of(rule, right, "set");
      if (elements == nullptr) return Match::unknown;
      return any_of(rule, left, *elements);
    }
    if (right.is_array()) return any_of(rule, left, right);
    return equals_one(left, right);
  }

  Match any_of(const Json& rule, const Json& left, const Json& list) {
    if (!list.is_array()) return equals(rule, left, list);
    Match best = Match::no;
    for (const Json& element : list) {
      const bool timed = element.is_object() && element.contains("elem");
      best = std::max(best, equals_one(left, timed ? element["elem"].value("val", Json()) : element));
    }
    return best;
  }

  // What is known of the datagram: from another PC by IPv4 and UDP, to this port, the first of its connection.
  [[nodiscard]] Match equals_one(const Json& left, const Json& right) const {
    if (!left.is_object()) return Match::unknown;
    if (const auto payload = left.find("payload"); payload != left.end()) {
      const std::string protocol = text(*payload, "protocol");
      const std::string field = text(*payload, "field");
      if (field == "dport" && (protocol == "udp" || protocol == "th")) return equals_port(right);
      if (protocol == "tcp" || protocol == "sctp" || protocol == "icmp" || protocol == "icmpv6" || protocol == "ip6")
        return Match::no;
      if (protocol == "ip" && field == "protocol") return equals_word(right, {"udp"}, 17);
      return Match::unknown;
    }
    if (const auto meta = left.find("meta"); meta != left.end()) {
      const std::string key = text(*meta, "key");
      if (key == "l4proto") return equals_word(right, {"udp"}, 17);
      if (key == "nfproto") return equals_word(right, {"ipv4"}, 2);
      if (key == "iif" || key == "iifname") return right == "lo" ? Match::no : Match::unknown;
      if (key == "pkttype") return equals_word(right, {"host", "unicast"}, 0);
      return Match::unknown;
    }
    if (const auto ct = left.find("ct"); ct != left.end() && text(*ct, "key") == "state")
      return equals_word(right, {"new"}, 8);
    return Match::unknown;
  }

  static Match equals_word(const Json& right, const std::vector<std::string>& words, int number) {
    if (right.is_number_integer()) return right == number ? Match::yes : Match::no;
    if (!right.is_string()) return Match::unknown;
    return std::ranges::find(words, right.get_ref<const std::string&>()) != words.end() ? Match::yes : Match::no;
  }

  [[nodiscard]] Match equals_port(const Json& right) const {
    if (right.is_number_integer()) return right == port_ ? Match::yes : Match::no;
    if (!right.is_object() || !right.contains("range") || !right["range"].is_array() || right["range"].size() != 2 ||
        !right["range"][0].is_number_integer() || !right["range"][1].is_number_integer())
      return Match::unknown;
    return right["range"][0] <= port_ && port_ <= right["range"][1] ? Match::yes : Match::no;
  }

  const Json* all_ = nullptr;
  const Json* closing_ = nullptr;
  int port_;
  std::deque<Json> scratch_;  // whose elements stay where they are
  bool perhaps_accepted_ = false;
  bool perhaps_dropped_ = false;
};

}  // namespace

FirewallVerdict judge_firewall(const nlohmann::json& ruleset, int udp_port) {
  return Ruleset(ruleset, udp_port).judge();
}

std::optional<ClosingChain> closing_chain(const nlohmann::json& ruleset, int udp_port) {
  Ruleset rules(ruleset, udp_port);
  if (rules.judge() != FirewallVerdict::keeps_out) return std::nullopt;
  return rules.closing();
}

std::string opening_command(const ClosingChain& chain, const std::string& sender, int first_port, int last_port) {
  if (chain.of_ufw)
    return fmt::format("sudo ufw allow proto udp from {} to any port {}:{}", sender, first_port, last_port);
  if (chain.table == "firewalld")
    return fmt::format(
        "sudo firewall-cmd --permanent --add-rich-rule='rule family=\"ipv4\" source address=\"{}\" port "
        "port=\"{}-{}\" protocol=\"udp\" accept'; sudo firewall-cmd --reload",
        sender, first_port, last_port);
  return fmt::format("sudo nft insert rule {} {} {} ip saddr {} udp dport {}-{} accept", chain.family, chain.table,
                     chain.name, sender, first_port, last_port);
}

}  // namespace telehug
