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


class Network:
    def __init__(self, a):
        self.rate, self.seed = a.rate, a.seed
        self.seconds, self.rounds = (2, 1) if a.short else (a.seconds, a.rounds)
        self.values = {False: [], True: [], None: []}  # under attack -> latencies in us; None: before it counts
        self.sent = self.answered = self.refused = self.acts = self.no_act = self.held = 0
        self.next_record, self.problems = 0, []

    def feed(self, pty, client, attacked):
        sent, refused = rig.feed(pty, client, self.rate, int(self.rate * self.seconds), self.next_record)
        self.next_record += int(self.rate * self.seconds)
        end = time.monotonic() + ANSWER_LIMIT_S
        while any(key not in client.seen for key in sent) and time.monotonic() < end:
            client.pump()
            time.sleep(0.01)
        values = rig.latencies_us(sent, client)
        self.values[attacked] += values
        self.sent += len(sent)
        self.answered += len(values)
        self.refused += refused

    def round(self, daemon, pty, client, number):
        self.feed(pty, client, False)
        with Attack(daemon.port, CLIENTS, self.seed + number) as attack:
            self.feed(pty, client, True)
            self.held = max(self.held, health(daemon.port)["clients"])
            self.acts += attack.counts[1]
            self.no_act += attack.counts[2]

    def run(self):
        folder = tempfile.mkdtemp(prefix="navcal-bench-")
        os.chmod(folder, 0o755)  # the socket's own permissions are what is tried
        pty = rig.Pty(folder, "compass")
        with rig.Daemon("navcald", [pty], folder=folder) as daemon:
            client = rig.Client(daemon.connect())
            self.next_record, _ = rig.warm_up(pty, client)
            with Attack(daemon.port, CLIENTS, self.seed):  # what the first crowd takes is kept for the next
                self.feed(pty, client, None)
            time.sleep(SETTLE_S)
            pid = daemon.process.pid
            before = process.descriptors(pid), process.anonymous_KiB(pid)
            for number in range(self.rounds):
                self.round(daemon, pty, client, number)
            end = time.monotonic() + 15
            while process.descriptors(pid) != before[0] and time.monotonic() < end:
                client.pump()
                time.sleep(0.1)
            after = process.descriptors(pid), process.anonymous_KiB(pid)
            self.nobody = control_as_nobody(f"{folder}/control")
            self.judge(daemon, before, after)
        self.growth_KiB = after[1] - before[1]
        self.descriptors = before[0], after[0]

    def judge(self, daemon, before, after):
        if daemon.process.poll() is not None:
            self.problems.append(f"navcald ended with {daemon.process.returncode}")
        if self.answered != self.sent:
            self.problems.append(f"{self.sent - self.answered} records not answered to the client that reads")
        if before[0] != after[0]:
            self.problems.append(f"{after[0]} descriptors, {before[0]} before")
        if self.nobody not in (None, "refused"):
            self.problems.append(f"a command by nobody was taken: {self.nobody}")
        if self.held < CLIENTS:
            self.problems.append(f"only {self.held} clients at once")


def run(a):
    network = Network(a)
    network.run()
    quantiles = {}
    for attacked, name in ((False, "undisturbed"), (True, "under_attack")):
        values = sorted(network.values[attacked])
        quantiles[name] = {n: round(rig.quantile(values, q), 1) for n, q in
                           (("p50_us", 0.5), ("p99_us", 0.99), ("p999_us", 0.999))}
    ratio = {n: round(quantiles["under_attack"][n] / quantiles["undisturbed"][n], 2) for n in quantiles["undisturbed"]}
    return {"clients_held": network.held, "acts": network.acts, "acts_refused": network.no_act, "records": network.sent,
            "answered": network.answered, **quantiles, "ratio": ratio, "descriptors": network.descriptors,
            "growth_KiB": network.growth_KiB, "command_by_nobody": network.nobody or "not tried: not root"}, network.problems
