// SPDX-License-Identifier: Apache-2.0
//
// Which topic and which wire type a message travels by. Only for this room and its tests.
#pragma once

#include <telehugPubSubTypes.h>

#include <string>

#include "common/messages.hpp"

namespace telehug {

template <typename T>
struct Topic;
template <>
struct Topic<TouchEvent> {
  using Wire = v1::TouchEvent;
  using WireSupport = v1::TouchEventPubSubType;
  static constexpr const char* name = "touch";
};
template <>
struct Topic<Felt> {
  using Wire = v1::Felt;
  using WireSupport = v1::FeltPubSubType;
  static constexpr const char* name = "felt";
};
template <>
struct Topic<Heartbeat> {
  using Wire = v1::Heartbeat;
  using WireSupport = v1::HeartbeatPubSubType;
  static constexpr const char* name = "heartbeat";
};
template <>
struct Topic<SideStatus> {
  using Wire = v1::SideStatus;
  using WireSupport = v1::SideStatusPubSubType;
  static constexpr const char* name = "status";
};
template <>
struct Topic<StopAll> {
  using Wire = v1::StopAll;
  using WireSupport = v1::StopAllPubSubType;
  static constexpr const char* name = "stop";
};
template <>
struct Topic<PairRenewal> {
  using Wire = v1::PairRenewal;
  using WireSupport = v1::PairRenewalPubSubType;
  static constexpr const char* name = "renewal";
};
template <>
struct Topic<Hug> {
  using Wire = v1::Hug;
  using WireSupport = v1::HugPubSubType;
  static constexpr const char* name = "hug";
};

// Topics are named after the side that writes them, so that a side does not hear itself and permissions can tell the
// directions apart: "telehug/v1/active/heartbeat".
template <typename T>
std::string topic_name(Side writing_side) {
  return std::string("telehug/v1/") + (writing_side == Side::active ? "active/" : "passive/") + Topic<T>::name;
}

}  // namespace telehug
