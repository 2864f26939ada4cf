// SPDX-License-Identifier: Apache-2.0
#include "dds/filtering_transport.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>

#include "dds/message_filter.hpp"

namespace telehug {
namespace {

namespace rtps = eprosima::fastrtps::rtps;
namespace transport = eprosima::fastdds::rtps;

class FilteringTransport final : public transport::ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  transport::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }

  bool send(rtps::SenderResource* sender, const rtps::octet* message, std::uint32_t size, rtps::LocatorsIterator* first,
            rtps::LocatorsIterator* last, const std::chrono::steady_clock::time_point& until) override {
    return sender->send(message, size, first, last, until);
  }

  void receive(transport::TransportReceiverInterface* receiver, const rtps::octet* message, std::uint32_t size,
               const rtps::Locator_t& here, const rtps::Locator_t& there) override {
    if (may_pass({message, size})) receiver->OnDataReceived(message, size, here, there);
  }
};

struct FilteringDescriptor final : transport::ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  [[nodiscard]] transport::TransportInterface* create_transport() const override {
    return new FilteringTransport(*this);
  }
};

}  // namespace

std::shared_ptr<transport::TransportDescriptorInterface> filtering(
    const std::shared_ptr<transport::TransportDescriptorInterface>& inner) {
  return std::make_shared<FilteringDescriptor>(inner);
}

}  // namespace telehug
