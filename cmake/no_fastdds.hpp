// SPDX-License-Identifier: Apache-2.0
// Included by the compiler before every file of a room that must not use Fast DDS (see Rooms.cmake).
#pragma GCC poison eprosima
