// SPDX-License-Identifier: Apache-2.0
#include "local_outputs.hpp"

#include "local_touch/tuio_sender.hpp"
#include "local_touch/uinput_touchscreen.hpp"

namespace telehug {

std::vector<std::unique_ptr<LocalTouchOutput>> local_outputs(const LocalTouchConfig& config) {
  std::vector<std::unique_ptr<LocalTouchOutput>> outputs;
  if (config.uinput) outputs.push_back(std::make_unique<UinputTouchscreen>());
  if (config.tuio) outputs.push_back(std::make_unique<TuioSender>(TuioSettings{config.tuio_host, config.tuio_port}));
  return outputs;
}

}  // namespace telehug
