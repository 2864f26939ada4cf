// SPDX-License-Identifier: Apache-2.0
// Modules of the active side's pages without a browser. Node.js 18 takes a .js file for a module only beside a package.json
// that says so, which the pages' folder has not: they are loaded from a copy.
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";

const pages = fileURLToPath(new URL("../../../active_side/web", import.meta.url));
const copy = fs.mkdtempSync(path.join(os.tmpdir(), "telehug-pages-"));
fs.cpSync(pages, copy, {recursive: true});
fs.writeFileSync(path.join(copy, "package.json"), '{"type": "module"}');
process.on("exit", () => fs.rmSync(copy, {recursive: true, force: true}));

export const load = (name) => import(pathToFileURL(path.join(copy, name)));
