// SPDX-License-Identifier: Apache-2.0
#include "screen_x11/x11_extensions.hpp"

#include <fmt/format.h>
#include <xcb/composite.h>
#include <xcb/damage.h>
#include <xcb/randr.h>
#include <xcb/shape.h>
#include <xcb/xfixes.h>

#include <array>

namespace telehug {

Status agree_on_x11_extensions(const X11Connection& connection) {
  xcb_connection_t* const server = connection.get();
  struct Needed {
    xcb_extension_t* id;
    const char* name;
  };
  constexpr std::array needed{Needed{&xcb_damage_id, "DAMAGE"}, Needed{&xcb_xfixes_id, "XFIXES"},
                              Needed{&xcb_randr_id, "RANDR"}, Needed{&xcb_composite_id, "Composite"},
                              Needed{&xcb_shape_id, "SHAPE"}};
  for (const Needed& extension : needed) {
    if (connection.extension(*extension.id) == nullptr) {
      return Error{fmt::format("The X11 display {} lacks the extension {}, which telehug needs; use another X server.",
                               connection.display(), extension.name)};
    }
  }
  const auto asked_damage = xcb_damage_query_version(server, 1, 1);
  const auto asked_xfixes = xcb_xfixes_query_version(server, 2, 0);
  const auto asked_randr = xcb_randr_query_version(server, 1, 5);
  const auto asked_composite = xcb_composite_query_version(server, 0, 2);
  const XcbOwned<xcb_damage_query_version_reply_t> damage(
      xcb_damage_query_version_reply(server, asked_damage, nullptr));
  const XcbOwned<xcb_xfixes_query_version_reply_t> xfixes(
      xcb_xfixes_query_version_reply(server, asked_xfixes, nullptr));
  const XcbOwned<xcb_randr_query_version_reply_t> randr(xcb_randr_query_version_reply(server, asked_randr, nullptr));
  const XcbOwned<xcb_composite_query_version_reply_t> composite(
      xcb_composite_query_version_reply(server, asked_composite, nullptr));
  const bool new_enough = damage && xfixes && xfixes->major_version >= 2 && randr &&
                          (randr->major_version > 1 || randr->minor_version >= 5) && composite &&
                          (composite->major_version > 0 || composite->minor_version >= 2);
  if (!new_enough) {
    return Error{
        fmt::format("The X11 display {} is too old (RandR 1.5 and Composite 0.2 are needed); use a newer X server.",
                    connection.display())};
  }
  return Done{};
}

}  // namespace telehug
