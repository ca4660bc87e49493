// SPDX-License-Identifier: Apache-2.0
// Emulated instruments, a navcald that reads them, and a navcal-web: the programs of the build, ended with this one.
import { spawn } from "node:child_process";
import { createServer } from "node:net";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const delay = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Waits until `condition` gives something, however slow the machine is; the limit only ends a test that hangs. */
export async function eventually(condition, what, limit_ms = 120_000) {
  for (const end = Date.now() + limit_ms; Date.now() < end; await delay(20)) {
    const result = condition();
    if (result) return result;
  }
  throw new Error(`waited in vain: ${what}`);
}

export function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });
}

const PORTS = ["compass", "imu", "gps", "motor"];
const CONFIG = fileURLToPath(new URL("../../../config/navcald.toml", import.meta.url));

export class Vehicle {
  constructor(build, folder) {
    this.build = build;
    this.folder = folder;
    this.programs = [];
  }

  start(command, ...args) {
    const child = spawn(join(this.build, command), args, { stdio: ["pipe", "pipe", "pipe"] });
    const program = { child, output: "", ended: new Promise((resolve) => child.on("exit", (code, signal) => resolve(signal ?? code))) };
    child.stdout.on("data", (data) => (program.output += data));
    child.stderr.on("data", (data) => (program.output += data));
    this.programs.push(program);
    return program;
  }

  async startInstruments() {
    this.instruments = this.start("cli/navcal", "emulate", "--dir", join(this.folder, "ports"), "--mission", "calibration_swing", "--seed", "5");
    await eventually(() => this.instruments.output.includes("ready"), "emulated instruments");
  }

  async startDaemon() {
    this.statusPort ??= await freePort();
    const settings = { "log.directory": join(this.folder, "logs"), "log.free_floor_MB": 0, "control.socket": join(this.folder, "control"),
      "status.port": this.statusPort, "navigation.interval_s": 0.1, "status.health_interval_s": 1,
      ...Object.fromEntries(PORTS.map((name) => [`port.${name}.path`, join(this.folder, "ports", name)])) };
    this.daemon = this.start("daemon/navcald", "--config", CONFIG, ...Object.entries(settings).flatMap(([key, value]) => ["--set", `${key}=${value}`]));
    await eventually(() => this.logs().length > 0, "navcald's log");
  }

  async startWeb() {
    this.webPort = await freePort();
    this.web = this.start("web/navcal-web", "--port", String(this.webPort), "--status", `127.0.0.1:${this.statusPort}`, "--control", join(this.folder, "control"));
    await eventually(() => this.web.output.includes("http://"), "navcal-web");
  }

  /** Its exit status, or the signal that ended it. */
  stop(program) {
    program.child.kill("SIGTERM");
    return program.ended;
  }

  end() {
    for (const { child } of this.programs) child.kill("SIGKILL");
  }

  logs() {
    const logs = join(this.folder, "logs");
    if (!existsSync(logs)) return [];
    return readdirSync(logs).filter((name) => name.endsWith(".mcap")).map((name) => join(logs, name));
  }

  diagnostics() {
    return this.programs.map((program) => `${program.child.spawnfile}:\n${program.output}`).join("\n");
  }
}

export const contents = (path) => readFileSync(path);
