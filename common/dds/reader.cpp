// SPDX-License-Identifier: Apache-2.0
#include "dds/reader.hpp"
#include "dds/dds_error.hpp"

#include <fmt/format.h>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <atomic>
#include <exception>
#include <stdexcept>
#include <utility>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"
#include "dds/wire.hpp"

namespace telehug {

namespace dds = eprosima::fastdds::dds;

namespace {

Side other(Side side) {
  return side == Side::active ? Side::passive : Side::active;
}

// A message that names its side must come by that side's topic.
template <typename T>
Fault check_origin(const T& message, Side writing_side) {
  if constexpr (requires { message.side; }) {
    if (message.side != writing_side) return "it claims to come from the other side";
  }
  return nullptr;
}

}  // namespace

template <typename T>
struct Reader<T>::Impl final : dds::DataReaderListener {
  Impl(std::shared_ptr<DdsParticipant::Impl> joined, Callback hand_over)
      : participant(std::move(joined)), writing_side(other(participant->side)), callback(std::move(hand_over)) {
    dds::Topic* topic = participant->topic<T>(writing_side);
    reader =
        participant->subscriber->create_datareader(topic, reader_qos<T>(), this, dds::StatusMask::data_available());
    if (reader == nullptr) {
      throw DdsError(fmt::format("DDS refused a reader of the topic {}", topic->get_name()));
    }
  }
  ~Impl() override {
    reader->set_listener(nullptr);
    participant->subscriber->delete_datareader(reader);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Fast DDS calls this from one thread at a time for one reader.
  void on_data_available(dds::DataReader* source) override {
    dds::SampleInfo info;
    while (source->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) judge();
    }
  }

  void judge() {
    if (!sample.intact) {
      ++malformed;
      return;
    }
    Fault fault = from_wire(sample.wire, message);
    if (fault == nullptr) fault = check_origin(message, writing_side);
    if (fault != nullptr) {
      last_fault = fault;
      ++invalid;
      return;
    }
    ++received;
    callback(message);
  }

  std::shared_ptr<DdsParticipant::Impl> participant;
  Side writing_side;
  Callback callback;
  Sample<T> sample;  // reused by every message, like `message`
  T message;
  std::atomic<std::uint64_t> received{0};
  std::atomic<std::uint64_t> malformed{0};
  std::atomic<std::uint64_t> invalid{0};
  std::atomic<Fault> last_fault{nullptr};
  dds::DataReader* reader = nullptr;
};

template <typename T>
Reader<T>::Reader(DdsParticipant& participant, Callback callback)
    : impl_(std::make_unique<Impl>(participant.impl(), std::move(callback))) {}
template <typename T>
Reader<T>::~Reader() = default;

template <typename T>
ReaderCounters Reader<T>::counters() const noexcept {
  return {.received = impl_->received,
          .malformed = impl_->malformed,
          .invalid = impl_->invalid,
          .last_fault = impl_->last_fault};
}

template class Reader<TouchEvent>;
template class Reader<Felt>;
template class Reader<Heartbeat>;
template class Reader<SideStatus>;
template class Reader<StopAll>;
template class Reader<PairRenewal>;
template class Reader<Hug>;

}  // namespace telehug
