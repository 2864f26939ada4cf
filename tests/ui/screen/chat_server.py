# SPDX-License-Identifier: Apache-2.0
"""Serves the chat page on a free port of this machine, passes orders to it and takes its answers."""
import http.server
import json
import os
import queue
import threading
import time

TYPES = {".html": "text/html", ".js": "text/javascript", ".jpg": "image/jpeg"}
HERE = os.path.dirname(os.path.abspath(__file__))
PAGE_FILES = ("chat_page.html", "chat_page.js", "talking_head.js")


class ChatServer:
    """Runs while it is entered, for one page. `pictures`: of each picture's name its file."""

    def __init__(self, pictures):
        self._files = {name: os.path.join(HERE, name) for name in PAGE_FILES} | pictures
        self._orders = queue.Queue()
        self._answers = queue.Queue()
        self._last_id = 0
        self._ending = threading.Event()
        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), self._handler())
        self._server.daemon_threads = True
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ending.set()
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    @property
    def url(self):
        return f"http://127.0.0.1:{self._server.server_address[1]}/chat_page.html"

    def order(self, order, timeout_s=30):
        """Has the page show something; its answer, with `answered_ns` when it came and `ordered_ns` when the order went
        out, both of the monotonic clock."""
        self._last_id += 1
        ordered_ns = time.monotonic_ns()
        self._orders.put({"id": self._last_id} | order)
        give_up = time.monotonic() + timeout_s
        while True:
            try:
                answer = self._answers.get(timeout=max(0.0, give_up - time.monotonic()))
            except queue.Empty:
                raise RuntimeError(f"the page did not answer within {timeout_s} s") from None
            if "problem" in answer:
                raise RuntimeError(f"the page can't show what it was ordered to: {answer['problem']}")
            if answer["id"] == self._last_id:
                return answer | {"ordered_ns": ordered_ns}

    def _handler(self):
        server = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_GET(self):
                name = self.path.lstrip("/")
                if name == "orders":
                    self._pass_orders()
                elif name in server._files:
                    self._send_file(server._files[name])
                else:
                    self.send_error(404)

            def do_POST(self):
                answered_ns = time.monotonic_ns()
                answer = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
                server._answers.put(answer | {"answered_ns": answered_ns})
                self.send_response(204)
                self.end_headers()

            def _send_file(self, path):
                with open(path, "rb") as file:
                    body = file.read()
                self.send_response(200)
                self.send_header("Content-Type", TYPES[os.path.splitext(path)[1]])
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

            def _pass_orders(self):
                self.send_response(200)
                self.send_header("Content-Type", "text/event-stream")
                self.send_header("Connection", "close")
                self.end_headers()
                while not server._ending.is_set():
                    try:
                        order = server._orders.get(timeout=0.2)
                    except queue.Empty:
                        continue
                    self.wfile.write(f"data: {json.dumps(order)}\n\n".encode())
                    self.wfile.flush()

            def log_message(self, *_):
                pass

        return Handler
