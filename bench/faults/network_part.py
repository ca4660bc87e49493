# SPDX-License-Identifier: Apache-2.0
"""The sockets under attack: what it costs the samples of a port, beside the undisturbed, in turn in one run."""
import json
import os
import pwd
import socket
import tempfile
import time

import serial_rig as rig
from faults import arguments, process
from faults.attackers import Attack

CLIENTS = 200
SETTLE_S = 1
ANSWER_LIMIT_S = 20
REFUSED, TAKEN, ANSWERED = range(3)
WORDS = {REFUSED: "refused", TAKEN: "taken", ANSWERED: "answered with an error"}


def add(commands):
    parser = arguments.common(commands, "network", "the sockets under attack")
    parser.add_argument("--rate", type=float, default=50)
    parser.add_argument("--seconds", type=float, default=20, help="of a round")
    parser.add_argument("--rounds", type=int, default=5)


def command(a):
    return f"bench/reliability network --rounds {a.rounds} --seconds {a.seconds:g} --seed {a.seed}"


def control_as_nobody(path):
    """What another user of the machine gets who sends a command; None when we are not root and cannot become one."""
    if os.geteuid() != 0:
        return None
    pid = os.fork()
    if pid == 0:
        nobody = pwd.getpwnam("nobody")
        os.setgroups([])
        os.setgid(nobody.pw_gid)
        os.setuid(nobody.pw_uid)
        try:
            with socket.socket(socket.AF_UNIX) as s:
                s.connect(path)
                s.sendall(b'{"command":"log.rotate"}\n')
                os._exit(TAKEN if b"true" in s.recv(100) else ANSWERED)
        except PermissionError:
            os._exit(REFUSED)
    return WORDS[os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])]


def health(port):
    with socket.create_connection(("127.0.0.1", port), timeout=20) as s:
        f = s.makefile()
        s.sendall(b'?WATCH={"enable":true,"json":true};\n')
        return next(json.loads(line) for line in f if line.startswith('{"class":"HEALTH"'))


class Station:
    """A navcald of its own with one port, and the client that reads it."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="navcal-bench-")
        os.chmod(self.folder, 0o755)  # the socket's own permissions are what is tried
        self.pty = rig.Pty(self.folder, "compass")
        self.daemon = rig.Daemon("navcald", [self.pty], folder=self.folder)
        self.values = {False: [], True: [], None: []}  # while there is an attack -> latencies in us; None: before it counts
        self.sent = self.answered = self.refused = 0

    def __enter__(self):
        self.client = rig.Client(self.daemon.connect())
        rig.warm_up(self.pty, self.client)
        return self

    def __exit__(self, *_):
        self.daemon.__exit__()

    def take(self, fed, during_attack):
        sent, refused = fed
        values = rig.latencies_us(sent, self.client)
        self.values[during_attack] += values
        self.sent += len(sent)
        self.answered += len(values)
        self.refused += refused


class Network:
    """One navcald is attacked; another, fed in turn with it, shows what the attackers cost whoever shares their machine."""

    def __init__(self, a):
        self.rate, self.seed = a.rate, a.seed
        self.seconds, self.rounds = (2, 1) if a.short else (a.seconds, a.rounds)
        self.acts = self.no_act = self.held = 0
        self.next_record, self.problems = 0, []

    def feed(self, during_attack):
        stations, records = (self.attacked, self.bystander), int(self.rate * self.seconds)
        fed = rig.feed_in_turn([(s.pty, s.client) for s in stations], self.rate, records, self.next_record)
        self.next_record += records
        clients = [s.client for s in stations]
        end = time.monotonic() + ANSWER_LIMIT_S
        while any(key not in c.seen for c, (sent, _) in zip(clients, fed) for key in sent) and time.monotonic() < end:
            rig.pump_all(clients)
            time.sleep(0.01)
        for station, result in zip(stations, fed):
            station.take(result, during_attack)

    def round(self, number):
        self.feed(False)
        with Attack(self.attacked.daemon.port, CLIENTS, self.seed + number) as attack:
            self.feed(True)
            self.held = max(self.held, health(self.attacked.daemon.port)["clients"])
            self.acts += attack.counts[1]
            self.no_act += attack.counts[2]

    def run(self):
        with Station() as self.attacked, Station() as self.bystander:
            daemon = self.attacked.daemon
            with Attack(daemon.port, CLIENTS, self.seed):  # what the first crowd takes is kept for the next
                self.feed(None)
            time.sleep(SETTLE_S)
            pid = daemon.process.pid
            before = process.descriptors(pid), process.anonymous_KiB(pid)
            for number in range(self.rounds):
                self.round(number)
            end = time.monotonic() + 15
            while process.descriptors(pid) != before[0] and time.monotonic() < end:
                rig.pump_all([self.attacked.client, self.bystander.client])
                time.sleep(0.1)
            after = process.descriptors(pid), process.anonymous_KiB(pid)
            self.nobody = control_as_nobody(f"{self.attacked.folder}/control")
            self.judge(daemon, before, after)
        self.growth_KiB = after[1] - before[1]
        self.descriptors = before[0], after[0]

    def judge(self, daemon, before, after):
        if daemon.process.poll() is not None:
            self.problems.append(f"navcald ended with {daemon.process.returncode}")
        if self.attacked.answered != self.attacked.sent:
            self.problems.append(f"{self.attacked.sent - self.attacked.answered} records not answered to the client that reads")
        if before[0] != after[0]:
            self.problems.append(f"{after[0]} descriptors, {before[0]} before")
        if self.nobody not in (None, "refused"):
            self.problems.append(f"a command by nobody was taken: {self.nobody}")
        if self.held < CLIENTS:
            self.problems.append(f"only {self.held} clients at once")


def quantiles(values):
    values = sorted(values)
    return {n: round(rig.quantile(values, q), 1) for n, q in (("p50_us", 0.5), ("p99_us", 0.99), ("p999_us", 0.999),
                                                                ("most_us", 1))}


def run(a):
    network = Network(a)
    network.run()
    attacked, bystander = network.attacked, network.bystander
    latency = {"before the attack": quantiles(attacked.values[False]), "under attack": quantiles(attacked.values[True]),
               "beside it, another navcald before the attack": quantiles(bystander.values[False]),
               "the other, during the attack": quantiles(bystander.values[True])}
    return {"clients_held": network.held, "acts": network.acts, "acts_refused": network.no_act, "records": attacked.sent,
            "answered": attacked.answered, "latency": latency, "descriptors": network.descriptors,
            "growth_KiB": network.growth_KiB, "command_by_nobody": network.nobody or "not tried: not root"}, network.problems
