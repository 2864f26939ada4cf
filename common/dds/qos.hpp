// SPDX-License-Identifier: Apache-2.0
//
// Every QoS choice of telehug, in one place. Only for this room.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "dds/settings.hpp"

namespace telehug {

// Throws std::invalid_argument if the settings can't work.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos participant_qos(const DdsSettings& settings);

// T: a message of common/messages.hpp.
template <typename T>
[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos();
template <typename T>
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos();

}  // namespace telehug
