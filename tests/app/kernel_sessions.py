"""The kernel as Jupyter's front ends use it: interrupts, restarts and ends of processes through jupyter_client.
Prints what it measured; any exception fails the test."""
import queue
import sys
import time

from jupyter_client.manager import start_new_kernel

ENDLESS = "while true do end"


def run(client, code, timeout=30):
    """The reply, and what was shown."""
    sent = client.execute(code)
    shown = []
    while True:
        message = client.get_iopub_msg(timeout=timeout)
        if message["parent_header"].get("msg_id") != sent:
            continue
        if message["msg_type"] == "status" and message["content"]["execution_state"] == "idle":
            break
        shown.append(message)
    while True:
        reply = client.get_shell_msg(timeout=timeout)
        if reply["parent_header"].get("msg_id") == sent:
            return reply["content"], shown


def text_of(shown):
    return "".join(m["content"]["text"] for m in shown if m["msg_type"] == "stream")


def interrupt_busy(manager, client):
    worst = 0
    for _ in range(5):
        sent = client.execute('print("on the way") ' + ENDLESS)
        while True:
            message = client.get_iopub_msg(timeout=30)
            if message["msg_type"] == "stream":
                break
        start = time.monotonic()
        manager.interrupt_kernel()
        while True:
            reply = client.get_shell_msg(timeout=30)
            if reply["parent_header"].get("msg_id") == sent:
                break
        worst = max(worst, time.monotonic() - start)
        assert reply["content"]["status"] == "error", reply["content"]
        assert reply["content"]["ename"] == "interrupted", reply["content"]
        reply, shown = run(client, "print(6 * 7)")
        assert reply["status"] == "ok" and text_of(shown) == "42\n", (reply, shown)
    print(f"interrupt {worst:.3f} s")
    assert worst < 0.2, worst


def interrupt_idle(manager, client):
    for i in range(20):
        # The control channel and the shell channel have no common order: without waiting for the reply, the interrupt may
        # arrive after the cell.
        client.control_channel.send(client.session.msg("interrupt_request", {}))
        assert client.get_control_msg(timeout=30)["content"]["status"] == "ok"
        reply, shown = run(client, f"print({i})")
        assert reply["status"] == "ok" and text_of(shown) == f"{i}\n", (i, reply, shown)


def restart(manager, client):
    run(client, "x = 5")
    manager.restart_kernel(now=False)
    client.wait_for_ready(timeout=30)
    reply, shown = run(client, "print(x)")
    assert reply["status"] == "error" and "unknown function or variable" in reply["evalue"], reply


def restart_busy(manager, client):
    client.execute(ENDLESS)
    start = time.monotonic()
    manager.restart_kernel(now=False)
    client.wait_for_ready(timeout=30)
    print(f"restart while busy {time.monotonic() - start:.2f} s")
    reply, shown = run(client, "print(1)")
    assert text_of(shown) == "1\n", shown


def end(manager, client):
    process = manager.provisioner.process
    manager.shutdown_kernel(now=False)
    assert process.poll() is not None
    client.stop_channels()


manager, client = start_new_kernel(kernel_name="dynlab")
try:
    for work in (interrupt_busy, interrupt_idle, restart, restart_busy, end):
        start = time.monotonic()
        work(manager, client)
        print(f"{work.__name__}: {time.monotonic() - start:.2f} s", flush=True)
except queue.Empty:
    sys.exit("the kernel did not answer")
finally:
    if manager.has_kernel:
        manager.shutdown_kernel(now=True)
