// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/homes/touch_ways.hpp"
#include "doubles/child_program.hpp"

namespace telehug {

// A key and a certificate for a broker at these addresses, made by OpenSSL in that folder.
void make_broker_certificate(const std::filesystem::path& folder, const std::vector<std::string>& addresses);

// mosquitto with TLS and without Nagle's algorithm, in the network of the calling thread, until its object ends.
[[nodiscard]] std::unique_ptr<ChildProgram> start_broker(const Meeting& meeting);

}  // namespace telehug
