# SPDX-License-Identifier: Apache-2.0
#
# Programs look for the files that come with them in ../share/telehug, from their own folder (common/data_folder.hpp). The
# build tree has that place, too, for the programs in bin/ and the tests.
set(TELEHUG_BUILT_DATA ${CMAKE_BINARY_DIR}/share/telehug)
file(MAKE_DIRECTORY ${TELEHUG_BUILT_DATA})

# telehug_data(FOLDER): in the build tree its files are those of the source.
function(telehug_data folder)
  get_filename_component(name ${folder} NAME)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR}/${folder} ${TELEHUG_BUILT_DATA}/${name} SYMBOLIC)
endfunction()
