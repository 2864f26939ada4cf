// SPDX-License-Identifier: Apache-2.0
#include "interop/dissection.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>

#include "doubles/child_program.hpp"

namespace telehug {
namespace {

constexpr std::array<const char*, 8> asked = {"frame.protocols",     "ip.reassembled_in",   "ip.src",
                                              "_ws.col.Info",        "rtps.sm.wrEntityId",  "rtps.param.topicName",
                                              "rtps.param.typeName", "rtps.param.partition"};

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + separator.size();
  }
  return parts;
}

}  // namespace

std::vector<Dissection> dissect(const std::filesystem::path& capture) {
  std::vector<std::string> command{"tshark", "-n", "-2", "-r", capture, "-T", "fields", "-E", "separator=/t"};
  for (const char* field : asked)
    command.insert(command.end(), {"-e", field});
  ChildProgram tshark(command);  // in two passes (-2): the pieces of a datagram are told only when it is known whole
  std::vector<Dissection> frames;
  while (const auto line = tshark.read_line_within(std::chrono::minutes(1))) {
    std::vector<std::string> fields = split(*line, "\t");
    fields.resize(asked.size());
    frames.push_back({.whole_in = fields[1].empty() ? frames.size() : std::stoul(fields[1]) - 1,
                      .rtps = fields[0].ends_with(":rtps"),
                      .source = fields[2],
                      .info = fields[3],
                      .submessages = split(fields[3], ", "),
                      .writers = split(fields[4], ","),
                      .topics = split(fields[5], ","),
                      .types = split(fields[6], ","),
                      .partitions = split(fields[7], ",")});
  }
  if (tshark.wait_for_end() != 0) throw std::runtime_error("tshark could not read " + capture.string());
  return frames;
}

}  // namespace telehug
