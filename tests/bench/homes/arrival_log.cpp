// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/arrival_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

namespace telehug {

ArrivalLog::ArrivalLog(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), file.string() + " can't be written");
}

ArrivalLog::~ArrivalLog() {
  close(descriptor_);
}

void ArrivalLog::add(const Arrival& arrival) const {
  if (write(descriptor_, &arrival, sizeof arrival) != static_cast<ssize_t>(sizeof arrival)) {
    throw std::system_error(errno, std::generic_category(), "an arrival can't be written down");
  }
}

std::vector<Arrival> arrivals_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  std::vector<Arrival> arrivals(bytes.size() / sizeof(Arrival));
  if (!arrivals.empty()) std::memcpy(arrivals.data(), bytes.data(), arrivals.size() * sizeof(Arrival));
  return arrivals;
}

}  // namespace telehug
