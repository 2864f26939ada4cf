// SPDX-License-Identifier: Apache-2.0
#include "dds/library_log.hpp"

#include <fmt/format.h>
#include <fastdds/dds/log/Log.hpp>

#include <memory>
#include <utility>

namespace telehug {
namespace {

using eprosima::fastdds::dds::Log;
using eprosima::fastdds::dds::LogConsumer;

class Teller final : public LogConsumer {
 public:
  explicit Teller(std::function<void(const std::string&)> tell) : tell_(std::move(tell)) {}

  void Consume(const Log::Entry& entry) override {
    const std::string place =
        fmt::format("{}, {}", entry.context.category, entry.context.function == nullptr ? "" : entry.context.function);
    if (const auto text = log_.heard(place, entry.message, SteadyClock{}.now())) tell_(*text);
  }

 private:
  std::function<void(const std::string&)> tell_;
  LibraryLog log_;
};

}  // namespace

std::optional<std::string> LibraryLog::heard(std::string_view place, std::string_view message, Timestamp now) {
  auto kind = kinds_.find(place);
  if (kind == kinds_.end() && kinds_.size() >= most_kinds)
    kind = kinds_.try_emplace("other places", Kind{now, 0}).first;
  if (kind == kinds_.end()) {
    kinds_.emplace(place, Kind{now, 0});
    return fmt::format("Fast DDS ({}): {}", place, message);
  }
  if (now - kind->second.told < quiet_time) {
    ++kind->second.untold;
    return std::nullopt;
  }
  const unsigned untold = std::exchange(kind->second, Kind{now, 0}).untold;
  return fmt::format("Fast DDS ({}): {} (and {} like it since the last)", place, message, untold);
}

void tell_library_log(std::function<void(const std::string&)> tell) {
  Log::ClearConsumers();
  Log::RegisterConsumer(std::make_unique<Teller>(std::move(tell)));
}

}  // namespace telehug
