// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <string>

#include "dds/guarded_type.hpp"
#include "dds/participant.hpp"
#include "dds/participant_number.hpp"

namespace telehug {

struct DdsParticipant::Impl {
  explicit Impl(const DdsSettings& settings);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // The topic of T that is written by `writing_side`; one per name, shared by its readers and writers.
  template <typename T>
  eprosima::fastdds::dds::Topic* topic(Side writing_side) {
    return find_or_create(topic_name<T>(writing_side), eprosima::fastdds::dds::TypeSupport(new GuardedType<T>()));
  }

  ParticipantNumber number;  // before the participant: given back after it
  Side side;
  eprosima::fastdds::dds::DomainParticipant* participant = nullptr;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;

 private:
  eprosima::fastdds::dds::Topic* find_or_create(const std::string& name,
                                                const eprosima::fastdds::dds::TypeSupport& type);
};

}  // namespace telehug
