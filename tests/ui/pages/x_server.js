// SPDX-License-Identifier: Apache-2.0
// An X server without a screen, on a display number of its own (Xvfb), with one monitor.
import {spawn} from "node:child_process";

export class XServer {
  // `size`: {width, height} in px.
  static async start({width, height}) {
    const server = new XServer();
    server.child = spawn("Xvfb", ["-displayfd", "3", "-screen", "0", `${width}x${height}x24`, "-nolisten", "tcp"],
                         {stdio: ["ignore", "ignore", "ignore", "pipe"]});
    server.display = await new Promise((done, failed) => {
      server.child.on("error", failed);
      server.child.on("exit", () => failed(new Error("Xvfb ends at once")));
      server.child.stdio[3].on("data", (number) => done(`:${String(number).trim()}`));
    });
    return server;
  }

  end() {
    this.child.kill("SIGTERM");
  }
}
