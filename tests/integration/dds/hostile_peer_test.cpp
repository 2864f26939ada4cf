// SPDX-License-Identifier: Apache-2.0
//
// A peer that is matched but sends rubbish: a writer with telehug's topic and type names whose payloads are any bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <functional>
#include <random>
#include <thread>
#include <vector>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"
#include "dds/reader.hpp"
#include "dds/writer.hpp"
#include "doubles/example_messages.hpp"
#include "doubles/inbox.hpp"
#include "doubles/unique_domain.hpp"

namespace telehug {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<unsigned char>;

// Sends std::vector<unsigned char> as it is, encapsulation header included.
class RawType : public dds::TopicDataType {
 public:
  RawType() {
    setName("telehug::v1::TouchEvent");
    m_typeSize = 4096;
    m_isGetKeyDefined = true;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes(); }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t* handle, bool) override {
    handle->value[0] = 1;
    return true;
  }
};

TEST(AHostilePeer, CanSendAnyBytesWithoutHarm) {
  const UniqueDomain domain;
  DdsParticipant passive({.side = Side::passive, .domain_id = domain.id(), .partition = domain.partition()});
  Inbox<TouchEvent> inbox;
  const Reader<TouchEvent> reader(passive, inbox.callback());

  DdsParticipant hostile({.side = Side::active, .domain_id = domain.id(), .partition = domain.partition()});
  const auto& inside = *hostile.impl();
  dds::TypeSupport type(new RawType());
  type.register_type(inside.participant);
  dds::Topic* topic = inside.participant->create_topic(topic_name<TouchEvent>(Side::active), type.get_type_name(),
                                                       dds::TOPIC_QOS_DEFAULT);
  ASSERT_NE(topic, nullptr);
  dds::DataWriter* writer = inside.publisher->create_datawriter(topic, writer_qos<TouchEvent>());
  ASSERT_NE(writer, nullptr);

  DdsParticipant active({.side = Side::active, .domain_id = domain.id(), .partition = domain.partition()});
  Writer<TouchEvent> honest(active);
  const auto give_up = std::chrono::steady_clock::now() + 10s;
  dds::PublicationMatchedStatus matched;
  while (matched.current_count == 0 || honest.matched() == 0) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up);
    std::this_thread::sleep_for(2ms);
    writer->get_publication_matched_status(matched);
  }

  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any_size(0, 600);
  constexpr std::uint64_t payloads = 3000;
  for (std::uint64_t i = 0; i < payloads; ++i) {
    Bytes bytes(any_size(random));
    for (auto& byte : bytes)
      byte = static_cast<unsigned char>(random());
    // Half of them with a right header, so that the fields are reached too.
    if (i % 2 == 0 && bytes.size() >= 4) std::memcpy(bytes.data(), "\x00\x01\x00\x00", 4);
    writer->write(&bytes);
  }

  // Best effort: the first honest one may be lost in the flood, so it is repeated.
  TouchEvent event = example_touch();
  do {
    ++event.sequence;
    ASSERT_TRUE(honest.write(event));
    ASSERT_LT(std::chrono::steady_clock::now(), give_up + 10s);
  } while (!inbox.wait_for(1, 20ms));
  EXPECT_EQ(inbox.messages().front().session, example_session);
  EXPECT_GT(reader.counters().malformed, payloads / 10);
  inside.publisher->delete_datawriter(writer);
}

}  // namespace
}  // namespace telehug
