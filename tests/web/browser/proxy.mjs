// SPDX-License-Identifier: Apache-2.0
// A proxy that serves navcal-web under a path, as BlueOS does, and a page with it in a frame.
import { createServer, request } from "node:http";
import { connect } from "node:net";

const PREFIX = "/extension/navcal";

export function startProxy(port) {
  const server = createServer((from, to) => {
    if (from.url === "/") return to.setHeader("content-type", "text/html").end(`<!doctype html><iframe title="navcal" src="${PREFIX}/" width="900" height="700"></iframe>`);
    if (!from.url.startsWith(`${PREFIX}/`)) return to.writeHead(404).end();
    const headers = { ...from.headers };
    request({ port, host: "127.0.0.1", path: from.url.slice(PREFIX.length), method: from.method, headers }, (answer) => {
      to.writeHead(answer.statusCode, answer.headers);
      answer.pipe(to);
    }).on("error", () => to.destroy()).end();
  });
  server.on("upgrade", (from, socket, head) => {
    const behind = connect(port, "127.0.0.1", () => {
      const lines = from.rawHeaders.reduce((all, text, i) => all + (i % 2 ? `: ${text}\r\n` : text), "");
      behind.write(`GET ${from.url.slice(PREFIX.length)} HTTP/1.1\r\n${lines}\r\n`);
      behind.write(head);
      socket.pipe(behind).pipe(socket);
    });
    for (const end of [socket, behind]) end.on("error", () => { socket.destroy(); behind.destroy(); });
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({ port: server.address().port, end: () => { server.closeAllConnections(); server.close(); } })));
}
