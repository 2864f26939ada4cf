// SPDX-License-Identifier: Apache-2.0
#include "feedback/felt_feedback.hpp"

#include "config/places.hpp"
#include "jacket/load_jacket_profile.hpp"
#include "link/make_link.hpp"

namespace telehug {
namespace {

constexpr Duration round = 10ms;  // the safety stage wants to be served this often

}  // namespace

Result<std::unique_ptr<FeltFeedback>> FeltFeedback::make(const FeedbackConfig& config, const Clock& clock) {
  if (config.link.empty()) return std::unique_ptr<FeltFeedback>();
  auto profile = load_jacket_profile(installed_jacket_file(config.profile));
  if (!profile) return profile.error();
  auto link = make_link(config.link, link_options(*profile));
  if (!link) return link.error();
  return std::make_unique<FeltFeedback>(*std::move(profile), *std::move(link), config.strength, clock);
}

FeltFeedback::FeltFeedback(JacketProfile profile, std::unique_ptr<JacketLink> link, double strength, const Clock& clock)
    : clock_(clock),
      drive_(std::move(profile), std::move(link), strength),
      problem_("it is being connected"),
      thread_([this] { loop(); }) {}

FeltFeedback::~FeltFeedback() {
  ending_ = true;
  thread_.join();
}

std::string FeltFeedback::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void FeltFeedback::loop() {
  for (Timestamp next = clock_.now(); !ending_; next += round) {
    serve(clock_.now());
    const Duration left = next + round - clock_.now();
    if (left > 0ms) {
      std::this_thread::sleep_for(left);
    } else {
      next = clock_.now();  // rounds that were missed are not made up for
    }
  }
  drive_.follow_stop(true, clock_.now());
}

void FeltFeedback::serve(Timestamp now) {
  drive_.follow_stop(stopped_, now);
  answers_.consume_all([&](const Felt& answer) {
    drive_.follow_stop(stopped_, now);  // one that came after a stop must find it
    drive_.feel(answer, now);
  });
  drive_.tick(now);
  const std::lock_guard lock(mutex_);
  problem_ = drive_.problem();
}

}  // namespace telehug
