// SPDX-License-Identifier: Apache-2.0
#include "dds/writer.hpp"
#include "dds/dds_error.hpp"

#include <fmt/format.h>
#include <fastdds/dds/publisher/DataWriter.hpp>

#include <exception>
#include <stdexcept>

#include "dds/participant_impl.hpp"
#include "dds/qos.hpp"
#include "dds/wire.hpp"

namespace telehug {

namespace dds = eprosima::fastdds::dds;

template <typename T>
struct Writer<T>::Impl {
  explicit Impl(std::shared_ptr<DdsParticipant::Impl> joined) : participant(std::move(joined)) {
    dds::Topic* topic = participant->topic<T>(participant->side);
    writer = participant->publisher->create_datawriter(topic, writer_qos<T>());
    if (writer == nullptr) {
      throw DdsError(fmt::format("DDS refused a writer of the topic {}", topic->get_name()));
    }
  }
  ~Impl() { participant->publisher->delete_datawriter(writer); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::shared_ptr<DdsParticipant::Impl> participant;
  dds::DataWriter* writer = nullptr;
  Sample<T> sample;  // reused by every write
};

template <typename T>
Writer<T>::Writer(DdsParticipant& participant) : impl_(std::make_unique<Impl>(participant.impl())) {}
template <typename T>
Writer<T>::~Writer() = default;

template <typename T>
bool Writer<T>::write(const T& message) noexcept {
  try {
    if (validate(message) != nullptr) return false;
    to_wire(message, impl_->sample.wire);
    return impl_->writer->write(&impl_->sample);
  } catch (const std::exception&) {
    return false;  // out of memory, or the middleware's own
  }
}

template <typename T>
int Writer<T>::matched() const noexcept {
  dds::PublicationMatchedStatus status;
  impl_->writer->get_publication_matched_status(status);
  return status.current_count;
}

template <typename T>
void Writer<T>::wait_until_heard(Duration longest) noexcept {
  try {
    const auto whole = std::chrono::floor<std::chrono::seconds>(longest);
    impl_->writer->wait_for_acknowledgments(
        {static_cast<std::int32_t>(whole.count()), static_cast<std::uint32_t>((longest - whole).count())});
  } catch (const std::exception&) {
    return;  // out of memory, or the middleware's own
  }
}

template class Writer<TouchEvent>;
template class Writer<Felt>;
template class Writer<Heartbeat>;
template class Writer<SideStatus>;
template class Writer<StopAll>;
template class Writer<PairRenewal>;
template class Writer<Hug>;

}  // namespace telehug
