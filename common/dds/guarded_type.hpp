// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <functional>

#include "dds/topics.hpp"

namespace telehug {

// What Fast DDS reads into and writes from.
template <typename T>
struct Sample {
  typename Topic<T>::Wire wire;
  bool intact = true;  // false: the payload could not be decoded, `wire` holds anything
};

// The generated type support lets exceptions of the decoder through, and Fast DDS lets them end the process: any
// matched peer could do that with one malformed payload. This one marks the sample instead, so that its reader can
// count it. (Answering false would leave the counting to nobody: Fast DDS drops such a sample silently.)
template <typename T>
class GuardedType final : public Topic<T>::WireSupport {
  using Generated = typename Topic<T>::WireSupport;
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

 public:
  bool serialize(void* data, Payload* payload) override {
    try {
      return Generated::serialize(&sample(data).wire, payload);
    } catch (const std::exception&) {
      return false;
    }
  }

  bool deserialize(Payload* payload, void* data) override {
    try {
      sample(data).intact = Generated::deserialize(payload, &sample(data).wire);
    } catch (const std::exception&) {
      sample(data).intact = false;
    }
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return Generated::getSerializedSizeProvider(&sample(data).wire);
  }

  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override {
    return Generated::getKey(&sample(data).wire, handle, force_md5);
  }

  void* createData() override { return new Sample<T>(); }
  void deleteData(void* data) override { delete static_cast<Sample<T>*>(data); }

 private:
  static Sample<T>& sample(void* data) { return *static_cast<Sample<T>*>(data); }
};

}  // namespace telehug
