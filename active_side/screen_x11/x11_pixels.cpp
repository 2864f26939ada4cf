// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_pixels.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <bit>

namespace telehug {
namespace {

constexpr std::uint32_t all_planes = ~std::uint32_t{0};
constexpr std::size_t pixel_bytes = 4;

const xcb_visualtype_t* find_visual(const xcb_screen_t& screen, xcb_visualid_t id) {
  for (auto depth = xcb_screen_allowed_depths_iterator(&screen); depth.rem > 0; xcb_depth_next(&depth)) {
    for (auto visual = xcb_depth_visuals_iterator(depth.data); visual.rem > 0; xcb_visualtype_next(&visual)) {
      if (visual.data->visual_id == id) {
        return visual.data;
      }
    }
  }
  return nullptr;
}

bool takes_four_bytes(const xcb_setup_t* setup, std::uint8_t depth) {
  for (auto format = xcb_setup_pixmap_formats_iterator(setup); format.rem > 0; xcb_format_next(&format)) {
    if (format.data->depth == depth) {
      return format.data->bits_per_pixel == 8 * pixel_bytes;
    }
  }
  return false;
}

}  // namespace

Status check_x11_pixels(const X11Connection& connection, std::uint8_t depth, xcb_visualid_t visual) {
  const xcb_setup_t* setup = xcb_get_setup(connection.get());
  const xcb_visualtype_t* type = find_visual(connection.screen(), visual);
  const bool colours = type != nullptr && type->_class == XCB_VISUAL_CLASS_TRUE_COLOR && type->red_mask == 0xFF0000 &&
                       type->green_mask == 0xFF00 && type->blue_mask == 0xFF;
  const bool bytes = setup->image_byte_order == XCB_IMAGE_ORDER_LSB_FIRST && takes_four_bytes(setup, depth);
  if ((depth == 24 || depth == 32) && colours && bytes) {
    return Done{};
  }
  return Error{
      fmt::format("The X11 display {} draws in a form of colours that can't be read (depth {}); set its depth to 24.",
                  connection.display(), depth)};
}

X11Pixels::X11Pixels(const X11Connection& connection) : connection_(connection) {
  // By handing over a descriptor, which needs version 1.2: a number of System V memory could mean somebody else's to a
  // server in another container.
  if (connection.is_local() && connection.extension(xcb_shm_id) != nullptr) {
    const XcbOwned<xcb_shm_query_version_reply_t> version(
        xcb_shm_query_version_reply(connection.get(), xcb_shm_query_version(connection.get()), nullptr));
    shares_memory_ = version && (version->major_version > 1 || version->minor_version >= 2);
  }
}

X11Pixels::~X11Pixels() {
  let_go();
}

void X11Pixels::let_go() {
  if (memory_ != nullptr) {
    xcb_shm_detach(connection_.get(), segment_);
    munmap(memory_, bytes_);
  }
  memory_ = nullptr;
  bytes_ = 0;
}

bool X11Pixels::make_room(std::size_t bytes) {
  if (bytes_ >= bytes) {
    return true;
  }
  let_go();
  const int fd = memfd_create("telehug screen", MFD_CLOEXEC);
  if (fd < 0 || ftruncate(fd, static_cast<off_t>(bytes)) != 0) {
    if (fd >= 0) close(fd);
    return false;
  }
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) {
    close(fd);
    return false;
  }
  segment_ = xcb_generate_id(connection_.get());
  const auto attached = xcb_shm_attach_fd_checked(connection_.get(), segment_, fd, 0);  // closes the descriptor
  const XcbOwned<xcb_generic_error_t> error(xcb_request_check(connection_.get(), attached));
  if (error || connection_.broken()) {
    munmap(memory, bytes);
    return false;
  }
  memory_ = memory;
  bytes_ = bytes;
  return true;
}

cv::Mat X11Pixels::read(xcb_drawable_t drawable, const cv::Rect& part_px) {
  sent_.reset();
  const auto x = static_cast<std::int16_t>(part_px.x);
  const auto y = static_cast<std::int16_t>(part_px.y);
  const auto width = static_cast<std::uint16_t>(part_px.width);
  const auto height = static_cast<std::uint16_t>(part_px.height);
  const std::size_t bytes = pixel_bytes * width * height;
  if (bytes == 0 || cv::Rect(x, y, width, height) != part_px) {  // beyond what the protocol counts in
    return {};
  }
  xcb_connection_t* const server = connection_.get();
  shares_memory_ = shares_memory_ && make_room(bytes);
  if (shares_memory_) {
    const auto asked =
        xcb_shm_get_image(server, drawable, x, y, width, height, all_planes, XCB_IMAGE_FORMAT_Z_PIXMAP, segment_, 0);
    const XcbOwned<xcb_shm_get_image_reply_t> reply(xcb_shm_get_image_reply(server, asked, nullptr));
    return reply && reply->size == bytes ? cv::Mat(part_px.size(), CV_8UC4, memory_) : cv::Mat();
  }
  const auto asked = xcb_get_image(server, XCB_IMAGE_FORMAT_Z_PIXMAP, drawable, x, y, width, height, all_planes);
  sent_.reset(xcb_get_image_reply(server, asked, nullptr));
  if (!sent_ || static_cast<std::size_t>(xcb_get_image_data_length(sent_.get())) < bytes) {
    return {};
  }
  return {part_px.size(), CV_8UC4, xcb_get_image_data(sent_.get())};
}

}  // namespace telehug
