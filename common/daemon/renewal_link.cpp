// SPDX-License-Identifier: Apache-2.0
#include "daemon/renewal_link.hpp"

#include <fmt/chrono.h>

#include <utility>

#include "service/log.hpp"

namespace telehug {
namespace {

std::string date(WallTime time) {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

std::uint64_t dropped_by(const Reader<PairRenewal>& reader) {
  const ReaderCounters counters = reader.counters();
  return counters.malformed + counters.invalid;
}

}  // namespace

RenewalSender::RenewalSender(const std::optional<Pair>& pair, SessionId session)
    : pair_(pair), session_(std::move(session)) {
  if (pair_) offer_.emplace(*pair_);
}

void RenewalSender::serve(WallTime now) {
  if (!offer_) return;
  if (const Status done = offer_->serve(now); !done)
    log_about({.stage = "pairing", .peer = pair_->name}, spdlog::level::warn, done.error().message);
  const auto& newest = offer_->newest();
  if (!newest) return;
  if (newest->certificate != offered_) {
    offered_ = newest->certificate;
    told_ = false;
    log_about({.stage = "pairing", .peer = pair_->name}, spdlog::level::info,
              fmt::format("the pair with {} is renewed until {}; the other PC gets that when it is connected",
                          pair_->name, date(present(*pair_).expires)));
  }
  if (writer_ && !told_) told_ = writer_->write({session_, newest->certificate, newest->permissions});
}

void RenewalSender::connect(DdsParticipant& participant) {
  disconnect();
  told_ = false;
  if (pair_) writer_.emplace(participant);
}

RenewalReceiver::RenewalReceiver(const std::optional<Pair>& pair) : pair_(pair) {}

void RenewalReceiver::serve(WallTime now) {
  auto come = slot_.take();
  if (!come || !pair_) return;
  PairStore store(pair_->files.private_key.parent_path().parent_path(), Side::active);
  const auto installed = store.install({pair_->id, std::move(come->certificate), std::move(come->permissions)}, now);
  if (!installed) {
    if (installed.error().message != told_problem_)
      log_about({.stage = "pairing", .peer = pair_->name}, spdlog::level::warn, installed.error().message);
    told_problem_ = installed.error().message;
  } else if (*installed) {
    log_about({.stage = "pairing", .peer = pair_->name}, spdlog::level::info,
              fmt::format("the pair with {} was renewed until {}", pair_->name, date((*installed)->expires)));
  }
}

void RenewalReceiver::disconnect() {
  const std::lock_guard lock(counting_);
  if (!reader_) return;
  dropped_before_ += dropped_by(*reader_);
  reader_.reset();
}

void RenewalReceiver::connect(DdsParticipant& participant) {
  disconnect();
  const std::lock_guard lock(counting_);
  if (pair_) reader_.emplace(participant, [this](const PairRenewal& renewal) { slot_.put(renewal); });
}

std::uint64_t RenewalReceiver::dropped() const {
  const std::lock_guard lock(counting_);
  return dropped_before_ + (reader_ ? dropped_by(*reader_) : 0);
}

}  // namespace telehug
