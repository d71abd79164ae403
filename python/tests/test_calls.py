"""Calls back into Python: progress, interrupts, rates as functions, threads; and that nothing is left behind."""

import gc
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import pelage


def test_progress_is_told(sphere):
    told = []
    pelage.grow(sphere, size=0.3, steps=20, progress=lambda what, fraction: told.append((what, fraction)))
    fractions = [fraction for what, fraction in told if what == "growing"]
    assert len(fractions) >= 20 and fractions == sorted(fractions)


def test_progress_stops(sphere):
    with pytest.raises(pelage.Cancelled):
        pelage.grow(sphere, size=0.3, progress=lambda what, fraction: what != "growing")
    with pytest.raises(ZeroDivisionError):
        pelage.grow(sphere, size=0.3, progress=lambda what, fraction: 1 / 0)


def test_a_run_that_was_stopped_goes_on(sphere):
    stop = [True]
    run = pelage.Run(sphere, size=0.3, steps=30, progress=lambda what, _: not (stop[0] and what == "growing"))
    with pytest.raises(pelage.Cancelled):
        run.advance(30)
    stop[0] = False
    assert np.array_equal(run.advance(30).get("b"), pelage.Run(sphere, size=0.3, steps=30).advance(30).get("b"))


INTERRUPTED = """
import os, signal, sys, threading, time
import pelage
run = pelage.Run("builtin:animal?n=5000", model="turing", size=0.03)
at = []
def press():
    at.append(time.monotonic())
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer(0.5, press).start()
try:
    while True:
        run.advance(10**9)
        run = pelage.Run("builtin:animal?n=5000", model="turing", size=0.03)
except KeyboardInterrupt:
    print("interrupted after", time.monotonic() - at[0])
"""


def test_ctrl_c_ends_a_growth():
    done = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0 and done.stdout.startswith("interrupted after"), done.stderr


SCHNAKENBERG = """
name = "own"
title = "Schnakenberg"
[species.u]
diffusion = "1"
rate = "0.1 - u + u^2*v"
initial = "1 + 0.01*noise(2)"
[species.v]
diffusion = "40"
rate = "0.9 - u^2*v"
initial = "0.9"
"""


def schnakenberg(t, u, v):
    reaction = u * u * v
    return 0.1 - u + reaction, 0.9 - reaction


def test_rates_as_a_function(sphere):
    """The same field as the same rates as text."""
    text, own = (pelage.Run(sphere, pelage.Model(SCHNAKENBERG, rates=rates), size=0.4, stepper="sbdf2", step=0.05,
                            steps=200).finish() for rates in (None, schnakenberg))
    assert np.ptp(text.get("u")) > 0.1
    assert np.abs(text.get("u") - own.get("u")).max() <= 1e-12 * np.abs(text.get("u")).max()


def test_rates_without_text(sphere):
    model = pelage.Model.from_rates(schnakenberg, {"u": 1, "v": 40}, {"u": "1 + 0.01*noise(2)", "v": 0.9}, spacing=11)
    text = pelage.Model(SCHNAKENBERG.replace('title = "Schnakenberg"', 'title = "Schnakenberg"\nwavelength = 11'))
    runs = [pelage.Run(sphere, m, size=0.4, stepper="sbdf2", step=0.05, steps=50).finish() for m in (model, text)]
    assert np.allclose(runs[0].get("v"), runs[1].get("v"), rtol=1e-12)


def test_rates_look_into_the_library(sphere):
    seen = []

    def rates(t, u, v):
        seen.append((t, u.flags.owndata, u.flags.writeable, len(u) == len(v)))
        return schnakenberg(t, u, v)

    pelage.Run(sphere, pelage.Model(SCHNAKENBERG, rates=rates), size=0.4, stepper="sbdf2", step=0.05, steps=2).finish()
    assert seen and all(owned is False and writeable is False and same for _, owned, writeable, same in seen)


@pytest.mark.parametrize("rates, fault, message", [
    (lambda t, u, v: (u, v[:-1]), ValueError, "as many as its concentrations"),
    (lambda t, u, v: u, ValueError, "one per species"),
    (lambda t, u: (u, u), TypeError, "positional"),
    (lambda t, u, v: 1 / 0, ZeroDivisionError, "division"),
])
def test_wrong_rates(sphere, rates, fault, message):
    with pytest.raises(fault, match=message):
        pelage.Run(sphere, pelage.Model(SCHNAKENBERG, rates=rates), size=0.4, stepper="sbdf2").advance(2)


def test_rates_cannot_be_split(sphere):
    with pytest.raises(pelage.UsageError, match="splits formulas"):
        pelage.Run(sphere, pelage.Model(SCHNAKENBERG, rates=schnakenberg), size=0.4, stepper="semi-implicit")


def test_two_runs_in_two_threads(sphere):
    alone = [pelage.Run(sphere, size=0.3, seed=seed).advance(40).get("b") for seed in (1, 2)]
    together = [None, None]

    def grow(i):
        together[i] = pelage.Run(sphere, size=0.3, seed=i + 1).advance(40).get("b")

    threads = [threading.Thread(target=grow, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(a, b) for a, b in zip(alone, together))


def test_python_goes_on_while_a_coat_grows(sphere):
    """The lock is given back: another thread counts on."""
    counted = [0]
    growing = threading.Event()

    def count():
        while not growing.is_set():
            counted[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    pelage.Run(sphere, size=0.05).advance(20)
    growing.set()
    counter.join()
    assert counted[0] > 1


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_nothing_is_left_of_many_runs():
    """Shapes, runs, coats and exceptions go: many runs take no more memory than the first ones. RUNS in the environment:
    how many, a thousand for a thorough test."""
    many = int(os.environ.get("RUNS", 150))
    shape = pelage.load("builtin:sphere?n=162")

    def once(i):
        run = pelage.Run(shape, size=0.8, method="linear", steps=2, seed=i, progress=lambda what, _: True).finish()
        run.coat().points
        with pytest.raises(pelage.UsageError):
            run.get("none")

    for i in range(50):
        once(i)
    gc.collect()
    before = resident()
    for i in range(many):
        once(i)
    gc.collect()
    assert resident() - before < 2 << 20


def test_signals_of_others_are_kept():
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
