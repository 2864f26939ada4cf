// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "dds/dds_error.hpp"
#include "dds/settings.hpp"
#include "dds/strangers.hpp"

namespace telehug {

// One program's membership in the DDS domain. UDPv4 only; discovery by multicast and, on loopback, without it.
// Readers and writers keep what they need of it alive, so the order of destruction is free. Create them from one
// thread.
class DdsParticipant {
 public:
  // Throws std::invalid_argument (settings that can't work) or std::runtime_error (no participant); what() is a
  // sentence.
  explicit DdsParticipant(const DdsSettings& settings);
  ~DdsParticipant();
  DdsParticipant(const DdsParticipant&) = delete;
  DdsParticipant& operator=(const DdsParticipant&) = delete;

  // How often another participant was discovered or proved who it is: grows while a peer is on its way to being heard.
  [[nodiscard]] std::uint64_t signs_of_peers() const noexcept;

  // Who announces itself and is not heard, since it does not prove to be of this pair; nothing without a pair.
  [[nodiscard]] std::optional<Stranger> stranger() const;
  [[nodiscard]] std::uint64_t refusals() const;

  struct Impl;
  [[nodiscard]] const std::shared_ptr<Impl>& impl() const noexcept { return impl_; }

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace telehug
