"""A stand-in for Agones' side-car: the paths, methods and bodies of its REST gateway, as Agones' OpenAPI files have them
(github.com/googleforgames/agones, sdks/swagger/sdk.swagger.json and beta.swagger.json). It answers what they do not have with
an error, and keeps what it was told."""

import http.server
import json
import re
import threading
import time

EMPTY = {}
# By method and path: the members of the body. Numbers of 64 bits are texts or numbers, as protocol buffers read both.
OPERATIONS = {
    ("POST", "/ready"): EMPTY, ("POST", "/health"): EMPTY, ("POST", "/allocate"): EMPTY, ("POST", "/shutdown"): EMPTY,
    ("POST", "/reserve"): {"seconds": int}, ("PUT", "/metadata/label"): {"key": str, "value": str},
    ("PUT", "/metadata/annotation"): {"key": str, "value": str},
}
COUNTER = {"count": int, "capacity": int, "countDiff": int}
STATES = {"/ready": "Ready", "/allocate": "Allocated", "/reserve": "Reserved", "/shutdown": "Shutdown"}
LABEL = re.compile(r"[A-Za-z0-9]([-A-Za-z0-9_.]{0,61}[A-Za-z0-9])?")


def is_like(value, kind):
    return re.fullmatch(r"-?[0-9]+", str(value)) is not None if kind is int else isinstance(value, kind)


class SideCar:
    def __init__(self, counters=("players",)):
        self.told = []  # (time, method, path, body), without signs of life
        self.lives = []  # the times of those
        self.labels = {}
        self.counters = {name: {"count": 0, "capacity": 0} for name in counters}
        self.state = "Scheduled"
        self.faults = []
        self.is_sick = False
        self.pause_s = 0.0  # before each answer
        self.asked = 0
        stand_in = self

        class Handler(http.server.BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def answer(self):
                body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
                status, said = stand_in.take(self.command, self.path, self.headers, body)
                data = json.dumps(said).encode()
                self.send_response(status)
                self.send_header("Content-Type", "application/json")
                self.send_header("Content-Length", str(len(data)))
                self.end_headers()
                self.wfile.write(data)

            do_GET = do_POST = do_PUT = do_PATCH = do_DELETE = answer

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.server.daemon_threads = True
        self.port = self.server.server_address[1]
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self):
        self.server.shutdown()
        self.server.server_close()

    def fault(self, status, words):
        self.faults.append(words)
        return status, {"message": words}

    def take(self, method, path, headers, data):
        self.asked += 1
        time.sleep(self.pause_s)
        if self.is_sick:
            return 500, {"message": "sick"}
        if headers.get("Content-Type") != "application/json":
            return self.fault(415, f"{method} {path} has the type {headers.get('Content-Type')}")
        try:
            body = json.loads(data)
        except ValueError:
            return self.fault(400, f"{method} {path}: no JSON: {data!r}")
        counter = re.fullmatch(r"/v1beta1/counters/([a-z]+)", path)
        members = COUNTER if counter and method == "PATCH" else OPERATIONS.get((method, path))
        if members is None:
            return self.fault(404, f"there is no {method} {path}")
        wrong = [name for name, value in body.items() if name not in members or not is_like(value, members[name])]
        if wrong:
            return self.fault(400, f"{method} {path}: {wrong} of {body}")
        if path == "/health":
            self.lives.append(time.monotonic())
            return 200, {}
        self.told.append((time.monotonic(), method, path, body))
        if path == "/metadata/label":
            if not LABEL.fullmatch(body["value"]):
                return self.fault(400, f"no value of a label: {body}")
            self.labels[body["key"]] = body["value"]
        if counter:
            name = counter.group(1)
            if name not in self.counters:
                return 404, {"message": "NOT_FOUND"}
            row = {**self.counters[name], **{key: int(value) for key, value in body.items()}}
            if not 0 <= row["count"] <= row["capacity"]:
                return self.fault(400, f"OUT_OF_RANGE: {row}")
            self.counters[name] = row
            return 200, {"name": name, **{key: str(value) for key, value in row.items()}}
        self.state = STATES.get(path, self.state)
        return 200, {}

    def paths(self):
        return [path for _, _, path, _ in self.told]
