"""deploy/nginx.conf in front of a service, on a free port, with a certificate of its own."""
import pathlib
import socket
import subprocess
import time

HOST = "plenum.example.org"
CONFIG = pathlib.Path(__file__).resolve().parent.parent.parent / "deploy" / "nginx.conf"


def start(folder, service_port):
    """The nginx process, with all its files in the folder, and its port."""
    subprocess.run(["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1",
                    "-subj", f"/CN={HOST}", "-keyout", f"{folder}/privkey.pem",
                    "-out", f"{folder}/fullchain.pem"], check=True, stderr=subprocess.DEVNULL)
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        free = probe.getsockname()[1]
    text = CONFIG.read_text()
    for old, new in (("listen 443", f"listen 127.0.0.1:{free}"), ("/etc/ssl/plenum", folder),
                     ("127.0.0.1:8080", f"127.0.0.1:{service_port}"), ("/var/log/nginx", folder),
                     ("/run/nginx.pid", f"{folder}/nginx.pid")):
        assert old in text, old
        text = text.replace(old, new)
    (pathlib.Path(folder) / "nginx.conf").write_text(text)
    subprocess.run(["nginx", "-t", "-q", "-c", f"{folder}/nginx.conf"], check=True)
    nginx = subprocess.Popen(["nginx", "-c", f"{folder}/nginx.conf", "-g", "daemon off;"])
    time.sleep(1)
    return nginx, free
