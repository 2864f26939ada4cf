// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "common/messages.hpp"

namespace telehug {

// Which box the overlay outlines: that of the contact that began last and still touches, and whether the other side has
// felt that contact.
class TouchedBox {
 public:
  struct Shown {
    std::uint16_t box = 0;
    bool felt = false;
  };

  // A contact as it was sent.
  void sent(const Contact& contact) {
    if (contact.phase == Phase::up) {
      if (shown_ && contact.id == contact_) shown_.reset();
      return;
    }
    const bool another = !shown_ || contact.id != contact_;
    if (another && contact.phase != Phase::down) return;
    if (another) shown_ = Shown{.felt = felt_ == contact.id};
    contact_ = contact.id;
    shown_->box = contact.box;
  }

  void felt(const Felt& felt) {
    if (felt.outcome != FeltOutcome::driven) return;
    felt_ = felt.contact_id;
    if (shown_ && felt.contact_id == contact_) shown_->felt = true;
  }

  // Nothing is sent any more.
  void clear() { shown_.reset(); }

  [[nodiscard]] const std::optional<Shown>& shown() const { return shown_; }

 private:
  std::uint32_t contact_ = 0;
  std::optional<std::uint32_t> felt_;  // the contact felt last: its answer may be here before itself
  std::optional<Shown> shown_;
};

}  // namespace telehug
