# SPDX-License-Identifier: Apache-2.0
"""camera.py DEVICE PER_SECOND FILE...: what a v4l2loopback camera sees, again and again, as MJPEG of 1280 x 720."""
import fcntl
import os
import struct
import sys
import time

V4L2_BUF_TYPE_VIDEO_OUTPUT = 2
VIDIOC_S_FMT = 0xC0D05605
VIDIOC_S_PARM = 0xC0CC5616


def feed(device, per_second, files):
    pictures = []
    for name in files:
        with open(name, "rb") as file:
            pictures.append(file.read())
    camera = os.open(device, os.O_RDWR)
    # v4l2_format: type, then (behind padding) width, height, pixelformat, field, bytesperline, sizeimage
    fcntl.ioctl(camera, VIDIOC_S_FMT,
                struct.pack("I4xII4sIII176x", V4L2_BUF_TYPE_VIDEO_OUTPUT, 1280, 720, b"MJPG", 1, 0, 1280 * 720 * 2))
    # v4l2_streamparm: type, then capability, outputmode, timeperframe
    fcntl.ioctl(camera, VIDIOC_S_PARM, struct.pack("IIIII184x", V4L2_BUF_TYPE_VIDEO_OUTPUT, 0, 0, 1, per_second))
    due = time.monotonic()
    while True:
        for picture in pictures:
            os.write(camera, picture)
            due += 1 / per_second
            time.sleep(max(0, due - time.monotonic()))


if __name__ == "__main__":
    feed(sys.argv[1], int(sys.argv[2]), sys.argv[3:])
