"""A proxy that strips a prefix from addresses and passes them on, as that of JupyterHub."""

import http.client
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

PASSED_ON = ("cookie", "accept", "host", "origin", "content-type", "sec-fetch-site")


class PrefixProxy(ThreadingHTTPServer):
    """Listens on a free port while used as a context.

    Attributes:
        paths: that were asked for.
    """

    daemon_threads = True

    def __init__(self, prefix, port):
        super().__init__(("127.0.0.1", 0), Handler)
        self.prefix, self.port, self.paths = prefix, port, []

    def address_of(self, query):
        """The start page with a query."""
        return f"http://127.0.0.1:{self.server_port}{self.prefix}/?{query}"

    def __enter__(self):
        threading.Thread(target=self.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.shutdown()
        self.server_close()

    def handle_error(self, request, client_address):
        """A browser that leaves in the middle is no error."""


class Handler(BaseHTTPRequestHandler):
    """One request, passed on as its parts come."""

    def do_GET(self):
        """Ask the server behind and pass its answer on."""
        self.server.paths.append(self.path)
        if not self.path.startswith(f"{self.server.prefix}/"):
            self.send_error(404)
            return
        behind = http.client.HTTPConnection("127.0.0.1", self.server.port)
        headers = {name: self.headers[name] for name in PASSED_ON if name in self.headers}
        behind.request("GET", self.path.removeprefix(self.server.prefix), headers=headers)
        answer = behind.getresponse()
        self.send_response(answer.status)
        for name, value in answer.getheaders():
            if name.lower() not in ("transfer-encoding", "connection", "date", "server"):
                self.send_header(name, value)
        self.end_headers()
        while part := answer.read1(65536):
            self.wfile.write(part)
            self.wfile.flush()
        behind.close()

    def log_message(self, *_):
        """Say nothing."""
