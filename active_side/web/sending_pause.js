// SPDX-License-Identifier: Apache-2.0
// Keeps touches from going to the wearer while the screen is used for something else, and lets them go again as before.
export class SendingPause {
  #command;
  #before = null;  // what sending was, if it is to become that again

  // command: as of /shared/page.js
  constructor(command) {
    this.#command = command;
  }

  async begin() {
    if (this.#before) return;
    const {sending} = await this.#command({command: "status"});
    if (sending.name === "off") return;
    await this.#command({command: "send", mode: "off"});
    this.#before = sending.name;
  }

  // options: of the request, for a page that is being left.
  async end(options) {
    const mode = this.#before;
    if (!mode) return;
    this.#before = null;
    await this.#command({command: "send", mode}, options);
  }
}
