// SPDX-License-Identifier: Apache-2.0
#include "pairing_link/pairing_dialogue.hpp"

namespace telehug {

namespace {

constexpr char kind_side = 's';
constexpr char kind_request = 'r';
constexpr char kind_grant = 'g';
constexpr char kind_confirmed = 'c';
constexpr char kind_failure = 'f';
constexpr std::size_t longest_failure = 500;

class Dialogue {
 public:
  Dialogue(TlsChannel& channel, std::chrono::milliseconds idle) : channel_(channel), idle_(idle) {}

  Status say(char kind, const std::string& text) { return channel_.send({.kind = kind, .text = text}, deadline()); }

  Result<std::string> hear(char kind) {
    auto message = channel_.receive(deadline());
    if (!message) return fail(message.error());
    if (message->kind == kind_failure)
      return Error{"the other PC can't go on: " + message->text.substr(0, longest_failure)};
    if (message->kind != kind)
      return fail({"the other PC does not keep to the order of a pairing: is its telehug older?"});
    return message->text;
  }

  // Tells the other PC as far as it still listens.
  Error fail(const Error& error) {
    (void)say(kind_failure, error.message.substr(0, longest_failure));
    return error;
  }

 private:
  [[nodiscard]] Deadline deadline() const { return std::chrono::steady_clock::now() + idle_; }

  TlsChannel& channel_;
  std::chrono::milliseconds idle_;
};

std::string word_of(Side side) {
  return side == Side::active ? "active" : "passive";
}

Status agree_on_sides(Dialogue& dialogue, Side side) {
  if (auto said = dialogue.say(kind_side, word_of(side)); !said) return said;
  auto other = dialogue.hear(kind_side);
  if (!other) return other.error();
  if (*other != word_of(side == Side::active ? Side::passive : Side::active))
    return Error{side == Side::active ? "both PCs are a parent's (active side): a pair needs the wearer's PC, too"
                                      : "both PCs are a wearer's (passive side): a pair needs a parent's PC, too"};
  return Done{};
}

Status ask(Dialogue& dialogue, const Offer& offer) {
  auto request = offer.make_request();
  if (!request) return dialogue.fail(request.error());
  if (auto said = dialogue.say(kind_request, *request); !said) return said;
  auto grant = dialogue.hear(kind_grant);
  if (!grant) return grant.error();
  if (auto accepted = offer.accept(*grant); !accepted) return dialogue.fail(accepted.error());
  return dialogue.say(kind_confirmed, "");
}

Status answer(Dialogue& dialogue, const Offer& offer) {
  auto request = dialogue.hear(kind_request);
  if (!request) return request.error();
  auto grant = offer.grant_for(*request);
  if (!grant) return dialogue.fail(grant.error());
  if (auto said = dialogue.say(kind_grant, *grant); !said) return said;
  auto confirmed = dialogue.hear(kind_confirmed);
  if (!confirmed) return confirmed.error();
  return Done{};
}

}  // namespace

Status talk(TlsChannel& channel, const Offer& offer, std::chrono::milliseconds idle) {
  Dialogue dialogue(channel, idle);
  if (auto agreed = agree_on_sides(dialogue, offer.side); !agreed) return agreed;
  return offer.side == Side::active ? ask(dialogue, offer) : answer(dialogue, offer);
}

}  // namespace telehug
