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
#include "dds/strangers.hpp"

namespace telehug {

// What other participants do that leads, or does not lead, to their being heard. Discovery is open to everybody: a sign
// proves nothing.
class SignsOfPeers final : public eprosima::fastdds::dds::DomainParticipantListener {
  using Discovery = eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
  using Authentication = eprosima::fastrtps::rtps::ParticipantAuthenticationInfo;

 public:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* own, Discovery&& info) override;
#if HAVE_SECURITY
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* own, Authentication&& info) override;
#endif

  std::atomic<std::uint64_t> count = 0;
  Strangers strangers;
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
  bool secured;
  eprosima::fastdds::dds::DomainParticipant* participant = nullptr;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;

 private:
  eprosima::fastdds::dds::Topic* find_or_create(const std::string& name,
                                                const eprosima::fastdds::dds::TypeSupport& type);
};

}  // namespace telehug
