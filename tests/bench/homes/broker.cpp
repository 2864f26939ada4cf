// SPDX-License-Identifier: Apache-2.0
#include "bench/homes/broker.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace telehug {
namespace {

constexpr const char* key_file = "broker.key";

}  // namespace

void make_broker_certificate(const std::filesystem::path& folder, const std::vector<std::string>& addresses) {
  std::string names = "subjectAltName=";
  for (const std::string& address : addresses)
    names += (names.back() == '=' ? "IP:" : ",IP:") + address;
  ChildProgram openssl({"openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                        "-days", "1", "-subj", "/CN=broker", "-addext", names, "-keyout", folder / key_file, "-out",
                        folder / broker_certificate});
  if (openssl.wait_for_end() != 0) throw std::runtime_error("openssl can't make the broker's certificate");
}

std::unique_ptr<ChildProgram> start_broker(const Meeting& meeting) {
  const std::filesystem::path config = meeting.folder / "mosquitto.conf";
  // Otherwise mosquitto would change to a user that may not read the key.
  std::ofstream(config) << fmt::format(
      "user root\nlistener {} {}\nallow_anonymous true\nset_tcp_nodelay true\npersistence false\nlog_type none\n"
      "certfile {}\nkeyfile {}\n",
      broker_port, meeting.address, (meeting.folder / broker_certificate).string(),
      (meeting.folder / key_file).string());
  // Silent: it warns of being root.
  return std::make_unique<ChildProgram>(
      std::vector<std::string>{"sh", "-c", "exec mosquitto -c \"$0\" 2>/dev/null", config});
}

}  // namespace telehug
