// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/container/static_vector.hpp>
#include <span>

#include "common/messages.hpp"
#include "safety/consent.hpp"
#include "subscribe/touch_order.hpp"

namespace telehug {

// Takes the touches at muted places out of an event, before it is planned what is felt of it.
class MutedTouches {
 public:
  // The event without them; the same one if nothing is muted. What is returned here and below is valid until the next
  // call, and while `touch` is. Allocates nothing from the second time on.
  const TouchEvent& leave_out(const OrderedTouch& touch, const MutedBoxes& muted);

  // The fresh transitions without them.
  [[nodiscard]] std::span<const Transition> fresh() const noexcept { return fresh_; }

  // Contacts and fresh transitions that were left out, each once, with the event in which it was new.
  [[nodiscard]] std::span<const Transition> left_out() const noexcept { return {left_out_.data(), left_out_.size()}; }

 private:
  TouchEvent allowed_;
  boost::container::static_vector<Transition, max_transitions> allowed_fresh_;
  boost::container::static_vector<Transition, max_contacts + max_transitions> left_out_;
  std::span<const Transition> fresh_;
};

}  // namespace telehug
