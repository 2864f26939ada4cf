// SPDX-License-Identifier: Apache-2.0
//
// Only for this room.
#pragma once

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

namespace telehug {

// `inner`, from which only what may_pass() reaches Fast DDS. Its settings are taken as they are now.
[[nodiscard]] std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> filtering(
    const std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface>& inner);

}  // namespace telehug
