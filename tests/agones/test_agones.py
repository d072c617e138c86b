"""A server beside a stand-in for Agones' side-car, from its start to its end; and the manifests, whose options are asked of the
server itself."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time

import pytest
import yaml

from side_car import SideCar

SERVER, BOT = os.environ["SCREE_SERVER_PROGRAM"], os.environ["SCREE_BOT_PROGRAM"]
MANIFESTS = pathlib.Path(os.environ["SCREE_SOURCE_DIR"]) / "docker" / "kubernetes"
PATIENCE_S = 60
OWN = {name: value for name, value in os.environ.items() if not name.startswith("SCREE_")}  # those are options


def comes(condition):
    end = time.monotonic() + PATIENCE_S
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


class Server:
    def __init__(self, side_car_port, *options):
        environment = {**OWN, "AGONES_SDK_HTTP_PORT": str(side_car_port)}
        self.process = subprocess.Popen([SERVER, "--port", "0", "--web", "off", "--terrain", "flat", "--agones", *options],
                                        env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.port = json.loads(self.process.stdout.readline())["listening"]

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.communicate(timeout=PATIENCE_S)[1], self.process.returncode

    def kill(self):
        self.process.kill()
        self.process.communicate()


@pytest.fixture
def side_car():
    stand_in = SideCar()
    yield stand_in
    stand_in.close()


@pytest.fixture
def start():
    started = []

    def run(*options):
        started.append(Server(*options))
        return started[-1]

    yield run
    for server in started:
        if server.process.poll() is None:
            server.kill()


def bot(port, carves=0):
    return subprocess.Popen([BOT, "--port", str(port), "--carves", str(carves)], env=OWN,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def test_a_life(side_car, start):
    server = start(side_car.port, "--world-name", "quarry", "--anonymous", "builder", "--sessions-max", "40", "--agones-kept", "7")
    assert comes(lambda: side_car.state == "Ready")
    assert comes(lambda: "scree-world" in side_car.labels)
    assert side_car.labels["scree-world"] == "quarry" and side_car.labels["scree-part"] == "world"
    assert re.fullmatch(r"[0-9.]+", side_car.labels["scree-version"])
    assert comes(lambda: side_car.counters["players"] == {"count": 0, "capacity": 40})
    visitor = bot(server.port, carves=1000)
    assert comes(lambda: side_car.state == "Allocated" and side_car.counters["players"]["count"] == 1)
    visitor.kill()
    visitor.wait()
    assert comes(lambda: side_car.state == "Reserved" and side_car.counters["players"]["count"] == 0)
    assert [body for _, _, path, body in side_car.told if path == "/reserve"] == [{"seconds": "7"}]
    assert comes(lambda: len(side_car.lives) >= 3)
    said, status = server.end()
    assert status == 0, said
    assert side_car.state == "Shutdown" and side_car.paths()[-1] == "/shutdown"
    assert side_car.paths().count("/ready") == 1
    assert side_car.faults == []


def test_a_side_car_that_is_sick_holds_up_nothing(side_car, start):
    side_car.is_sick = True
    server = start(side_car.port, "--anonymous", "builder")
    assert bot(server.port, carves=2).wait(timeout=PATIENCE_S) == 0
    side_car.is_sick = False
    assert comes(lambda: side_car.state == "Ready")
    said, status = server.end()
    assert status == 0
    assert said.count("is not told, and is tried again") == 1 and "the side-car answers 500" in said
    assert said.count("answers again") == 1


def test_an_end_waits_for_two_requests_of_a_side_car_that_hangs(side_car, start):
    server = start(side_car.port, "--anonymous", "builder")
    assert comes(lambda: "scree-part" in side_car.labels and "/v1beta1/counters/players" in side_car.paths())
    side_car.pause_s = 3  # the server waits for 2
    asked = side_car.asked
    visitor = bot(server.port, carves=1000)
    assert comes(lambda: side_car.asked > asked)
    server.process.send_signal(signal.SIGTERM)
    asked = side_car.asked
    said, status = server.end()
    visitor.kill()
    visitor.wait()
    assert status == 0 and "is not told, and is tried again" in said
    assert side_car.asked - asked <= 2


def test_without_a_side_car_the_server_serves_and_ends(start):
    server = start(9)  # nobody listens there
    assert bot(server.port).wait(timeout=PATIENCE_S) == 0
    said, status = server.end()
    assert status == 0 and "is not told, and is tried again" in said


def test_a_simulation_that_stands_still_gives_no_sign_of_life(side_car, start):
    server = start(side_car.port)
    assert comes(lambda: side_car.lives)
    server.process.send_signal(signal.SIGSTOP)
    time.sleep(0.5)
    count = len(side_car.lives)
    time.sleep(4)
    assert len(side_car.lives) == count
    server.process.send_signal(signal.SIGCONT)
    assert comes(lambda: len(side_car.lives) > count)


def test_a_fleet_without_counters(start):
    stand_in = SideCar(counters=())
    server = start(stand_in.port, "--anonymous", "builder")
    visitor = bot(server.port, carves=1000)
    assert comes(lambda: stand_in.state == "Allocated")
    visitor.kill()
    visitor.wait()
    said, status = server.end()
    assert status == 0 and said.count('no counter "players"') == 1
    assert sum(path.startswith("/v1beta1") for path in stand_in.paths()) == 1
    stand_in.close()


@pytest.mark.parametrize("port", ["0", "70000", "http", ""])
def test_what_is_no_port_is_refused(port):
    refused = subprocess.run([SERVER, "--agones"], env={**OWN, "AGONES_SDK_HTTP_PORT": port}, capture_output=True, text=True)
    assert refused.returncode == 2 and "AGONES_SDK_HTTP_PORT" in refused.stderr


# ---- manifests


def manifests():
    listed = yaml.safe_load((MANIFESTS / "kustomization.yaml").read_text())["resources"]
    assert sorted(listed) == sorted(path.name for path in MANIFESTS.glob("*.yaml") if path.name != "kustomization.yaml")
    return [manifest for name in listed for manifest in yaml.safe_load_all((MANIFESTS / name).read_text())]


def pods(value):
    """All specs of pods within a manifest."""
    if isinstance(value, dict):
        if "containers" in value:
            yield value
        for inner in value.values():
            yield from pods(inner)


def test_servers_take_the_options_of_their_manifests(tmp_path):
    unknown = {"simulator": "nats://simulator:s@nats:4222", "edge": "nats://edge:e@nats:4222"}
    found = 0
    for manifest in manifests():
        for pod in pods(manifest):
            (container,) = pod["containers"]
            environment = {"PATH": os.environ["PATH"], "HOME": str(tmp_path)}
            for row in container["env"]:
                secret = row.get("valueFrom", {}).get("secretKeyRef")
                value = unknown[secret["key"]] if secret else row.get("value", "a-pod-1")
                environment[row["name"]] = value.replace("/worlds/", f"{tmp_path}/")
            printed = subprocess.run([SERVER, "config", "print", "--bind", "0.0.0.0", *container["args"]], env=environment,
                                     capture_output=True, text=True)
            assert printed.returncode == 0, f"{manifest['metadata']['name']}: {printed.stderr}"
            found += 1
    assert found == 3


def test_pods_have_no_rights_and_volumes_for_all_that_they_write():
    for manifest in manifests():
        for pod in pods(manifest):
            (container,) = pod["containers"]
            context = container["securityContext"]
            assert context["runAsNonRoot"] and context["readOnlyRootFilesystem"] and not context["allowPrivilegeEscalation"]
            assert context["capabilities"] == {"drop": ["ALL"]}
            assert pod["securityContext"]["seccompProfile"] == {"type": "RuntimeDefault"}
            assert {mount["name"] for mount in container["volumeMounts"]} == {volume["name"] for volume in pod["volumes"]}
            files = [row["value"] for row in container["env"] if str(row.get("value", "")).startswith("/")]
            mounts = [mount["mountPath"] for mount in container["volumeMounts"]]
            assert all(any(path.startswith(mount + "/") for mount in mounts) for path in files)


def test_names_agree():
    by_kind = {}
    for manifest in manifests():
        by_kind.setdefault(manifest["kind"], {})[manifest["metadata"]["name"]] = manifest["spec"] if "spec" in manifest else manifest
    fleet, scaler = by_kind["Fleet"]["worlds"], by_kind["FleetAutoscaler"]["worlds"]
    assert scaler["fleetName"] in by_kind["Fleet"]
    counter = scaler["policy"]["counter"]
    assert counter["key"] in fleet["template"]["spec"]["counters"]
    seats = fleet["template"]["spec"]["counters"]["players"]["capacity"]
    assert counter["minCapacity"] >= seats and counter["bufferSize"] <= counter["minCapacity"]
    edges = by_kind["Deployment"]["quarry-edges"]
    labels = edges["template"]["metadata"]["labels"]
    assert edges["selector"]["matchLabels"] == labels == by_kind["Service"]["quarry"]["selector"]
    assert by_kind["PodDisruptionBudget"]["quarry-edges"]["selector"]["matchLabels"] == labels
    claims = [volume["persistentVolumeClaim"]["claimName"] for volume in by_kind["Fleet"]["quarry"]["template"]["spec"]["template"]["spec"]["volumes"]
              if "persistentVolumeClaim" in volume]
    assert claims == list(by_kind["PersistentVolumeClaim"])
