// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>

namespace telehug {

// A DDS domain that no other test on this machine uses while this object lives (a file lock per domain, which the
// kernel drops with the process), and a partition of its own besides.
class UniqueDomain {
 public:
  UniqueDomain() {
    std::random_device random;
    partition_ = "test-" + std::to_string(random()) + "-" + std::to_string(random());
    const std::uint32_t first = random() % domains;
    for (std::uint32_t i = 0; i < domains && lock_ < 0; ++i)
      claim(1 + (first + i) % domains);
    if (lock_ < 0) throw std::runtime_error("every DDS domain is claimed by another test");
  }
  ~UniqueDomain() { close(lock_); }
  UniqueDomain(const UniqueDomain&) = delete;
  UniqueDomain& operator=(const UniqueDomain&) = delete;

  // 1..100; 0 is left to what is installed
  [[nodiscard]] std::uint32_t id() const noexcept { return id_; }
  [[nodiscard]] const std::string& partition() const noexcept { return partition_; }

 private:
  static constexpr std::uint32_t domains = 100;  // higher ones use ports that the kernel hands out

  void claim(std::uint32_t id) {
    const auto file = std::filesystem::temp_directory_path() / ("telehug-test-domain-" + std::to_string(id) + ".lock");
    const int descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor < 0) return;
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor);
      return;
    }
    lock_ = descriptor;
    id_ = id;
  }

  int lock_ = -1;
  std::uint32_t id_ = 0;
  std::string partition_;
};

}  // namespace telehug
