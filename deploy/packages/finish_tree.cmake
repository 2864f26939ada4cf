# SPDX-License-Identifier: Apache-2.0
#
# Run by cpack when the three trees are installed and not packed yet: what a Debian package has that an installation has not.
set(release ${CPACK_DEBIAN_PACKAGE_RELEASE})
set(time $ENV{SOURCE_DATE_EPOCH})
if(time STREQUAL "")
  message(FATAL_ERROR "SOURCE_DATE_EPOCH must say of when the packages are: use deploy/packages/build")
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH

foreach(part IN LISTS CPACK_COMPONENTS_ALL)
  set(tree ${CPACK_TEMPORARY_DIRECTORY}/${part})
  # What people edit.
  if(NOT part STREQUAL common)
    file(MAKE_DIRECTORY ${tree}/etc/telehug/${part}.d)
    file(RENAME ${tree}/usr/share/telehug/config/${part}.toml ${tree}/etc/telehug/${part}.toml)
    file(REMOVE_RECURSE ${tree}/usr/share/telehug/config)
  endif()
  # Debian 12's own tools look for units and rules there.
  foreach(moved systemd/system udev)
    if(EXISTS ${tree}/usr/lib/${moved})
      get_filename_component(above ${tree}/lib/${moved} DIRECTORY)
      file(MAKE_DIRECTORY ${above})
      file(RENAME ${tree}/usr/lib/${moved} ${tree}/lib/${moved})
    endif()
  endforeach()
  file(GLOB left ${tree}/usr/lib/systemd/*)
  if(NOT left)
    file(REMOVE_RECURSE ${tree}/usr/lib/systemd)
  endif()

  set(documents ${tree}/usr/share/doc/telehug-${part})
  file(WRITE ${documents}/changelog.Debian
    "telehug (${CPACK_PACKAGE_VERSION}-${release}) bookworm; urgency=medium\n\n"
    "  * ${CPACK_PACKAGE_VERSION}; changelog.gz tells what is new.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9n ${documents}/changelog ${documents}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)

  if(EXISTS ${CPACK_TELEHUG_PACKAGES}/lintian/telehug-${part})
    file(COPY ${CPACK_TELEHUG_PACKAGES}/lintian/telehug-${part} DESTINATION ${tree}/usr/share/lintian/overrides)
  endif()
  # The same packages from the same source, whatever the umask and whenever.
  execute_process(COMMAND chmod -R u=rwX,go=rX ${tree} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND find ${tree} -exec touch --no-dereference --date=@${time} {} + COMMAND_ERROR_IS_FATAL ANY)
endforeach()
