# SPDX-License-Identifier: Apache-2.0
#
# Three Debian packages, by `deploy/packages/build DIR`: what both sides need, and one for each side.
set(packages ${PROJECT_SOURCE_DIR}/deploy/packages)

install(FILES deploy/desktop/telehug.desktop DESTINATION share/applications COMPONENT common)
install(FILES deploy/desktop/telehug.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT common)
install(FILES deploy/firewall/telehug.nft DESTINATION share/telehug/firewall COMPONENT common)
install(FILES deploy/grafana/telehug.json DESTINATION share/telehug/grafana COMPONENT common)
install(DIRECTORY docs/ DESTINATION share/doc/telehug-common/docs COMPONENT common)
# What its pages for those who use telehug lead to.
foreach(page README.md ARCHITECTURE.md common/web/README.md deploy/firewall/telehug.nft deploy/jackets/README.md
    passive_side/firmware/README.md passive_side/firmware/wiring_motors12_heaters2.svg
    passive_side/firmware/wiring_motors16.svg passive_side/gpio/README.md passive_side/rendering/README.md
    passive_side/wire/README.md)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION share/doc/telehug-common/${folder} COMPONENT common)
endforeach()
foreach(part common active passive)
  install(FILES CHANGELOG.md DESTINATION share/doc/telehug-${part} RENAME changelog COMPONENT ${part})
  install(FILES deploy/packages/copyright DESTINATION share/doc/telehug-${part} COMPONENT ${part})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL common active passive)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_TELEHUG_PACKAGES ${packages})
set(CPACK_PRE_BUILD_SCRIPTS ${packages}/finish_tree.cmake)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_VENDOR telehug)
set(CPACK_PACKAGE_CONTACT "telehug maintainers <maintainers@telehug.example>")

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION video)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SOURCE telehug)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENT_ACTIVE_DEPENDS common)
set(CPACK_COMPONENT_PASSIVE_DEPENDS common)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# telehug_package(PART SUMMARY text DESCRIPTION text DEPENDS text RECOMMENDS text SUGGESTS text)
# What programs are linked with is found by dpkg-shlibdeps; DEPENDS is what they load, run or read beside that.
macro(telehug_package part)
  cmake_parse_arguments(arg "" "SUMMARY;DESCRIPTION;DEPENDS;RECOMMENDS;SUGGESTS" "" ${ARGN})
  string(TOUPPER ${part} PART)
  set(CPACK_DEBIAN_${PART}_PACKAGE_NAME telehug-${part})
  set(CPACK_DEBIAN_${PART}_DESCRIPTION "${arg_SUMMARY}\n${arg_DESCRIPTION}")
  set(CPACK_DEBIAN_${PART}_PACKAGE_DEPENDS "${arg_DEPENDS}")
  set(CPACK_DEBIAN_${PART}_PACKAGE_RECOMMENDS "${arg_RECOMMENDS}")
  set(CPACK_DEBIAN_${PART}_PACKAGE_SUGGESTS "${arg_SUGGESTS}")
  file(GLOB CPACK_DEBIAN_${PART}_PACKAGE_CONTROL_EXTRA CONFIGURE_DEPENDS ${packages}/${part}/*)
endmacro()

telehug_package(common
  SUMMARY "touch a child's picture in a video chat: what both sides need"
  DESCRIPTION "telehug lets a parent touch the picture of a child in a video chat
on an ordinary monitor, which a webcam watches. The child feels the
touch through a haptic jacket.\n.\nThis package holds the command telehug, which pairs, shows and stops,
the profiles and firmware of jackets, the manual, and the account of
the services."
  DEPENDS "systemd | systemd-standalone-sysusers, systemd | systemd-standalone-tmpfiles"
  RECOMMENDS "xdg-utils, avrdude"
  SUGGESTS "nftables, wireguard-tools")
telehug_package(active
  SUMMARY "touch a child's picture in a video chat: the parent's side"
  DESCRIPTION "The parent's side of telehug sees by a webcam where fingers touch the
monitor, and which part of the person in the video chat is there, and
sends that to the wearer's PC.\n.\nIt runs in the session of the person who sits at the monitor, or as a
service of a fixed rig."
  DEPENDS "libpipewire-0.3-modules"
  RECOMMENDS "opencv-data, pipewire, xdg-desktop-portal"
  SUGGESTS "v4l-utils")
telehug_package(passive
  SUMMARY "touch a child's picture in a video chat: the wearer's side"
  DESCRIPTION "The wearer's side of telehug is a service that drives the motors and
heaters of a haptic jacket, at a serial port or by Bluetooth, within
limits that nothing exceeds.\n.\nIt comes with a simulated jacket, to try everything without one."
  RECOMMENDS "bluez")

# cpack puts any but its own default above every description; each has a first line of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
include(CPack)
