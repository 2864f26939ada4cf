// SPDX-License-Identifier: Apache-2.0
#include "pairing/renewal_offer.hpp"

#include <stdexcept>

#include "pairing/pair_files.hpp"

namespace telehug {
namespace {

constexpr auto look_interval = std::chrono::seconds(10);
constexpr auto retry_interval = std::chrono::hours(1);

// Also when the clock was set back.
bool is_over(WallTime since, std::chrono::seconds interval, WallTime now) {
  return now < since || now - since >= interval;
}

}  // namespace

RenewalOffer::RenewalOffer(const Pair& pair) : store_(folder_of(pair).parent_path(), Side::passive), id_(pair.id) {}

Status RenewalOffer::serve(WallTime now) {
  if (!is_over(looked_at_, look_interval, now)) return Done{};
  looked_at_ = now;
  const Status done = look(now);
  if (done || !is_over(failed_at_, retry_interval, now)) return Done{};
  failed_at_ = now;
  return done;
}

Status RenewalOffer::look(WallTime now) {
  try {
    const auto pair = store_.find(id_);
    if (!pair) return Done{};
    newest_ = store_.newest_renewal(*pair);
    if (now + renewed_before_end < store_.first_end(*pair)) return Done{};
    auto made = store_.renew(*pair, now);
    if (!made) return made.error();
    newest_ = *std::move(made);
    return Done{};
  } catch (const std::runtime_error& problem) {
    return Error{problem.what()};
  }
}

}  // namespace telehug
