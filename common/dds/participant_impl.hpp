// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <string>

#include "dds/guarded_type.hpp"
#include "dds/participant.hpp"
#include "dds/participant_number.hpp"

namespace telehug {

// Counts what other participants do that leads to their being heard. Discovery is open to everybody: a sign proves
// nothing.
class SignsOfPeers final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* /*own*/,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override {
    if (info.status == eprosima::fastrtps::rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT) ++count;
  }
#if HAVE_SECURITY
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* /*own*/,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override {
    if (info.status == eprosima::fastrtps::rtps::ParticipantAuthenticationInfo::AUTHORIZED_PARTICIPANT) ++count;
  }
#endif

  std::atomic<std::uint64_t> count = 0;
};

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

  SignsOfPeers signs;        // before the participant, which calls it
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
