"""A plain client of the Language Server Protocol: JSON-RPC over the pipes of a process."""

from __future__ import annotations

import json
import queue
import subprocess
import sys
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WAIT_S = 30


class LspClient:
    """Starts `trg lsp` and speaks to it; `offered` are the position encodings that it claims to know."""

    def __init__(self, *arguments: str, offered: tuple[str, ...] = ()) -> None:
        command = [sys.executable, "-m", "trg_blender", "lsp", *arguments]
        self.process = subprocess.Popen(
            command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self.messages: queue.Queue[dict | None] = queue.Queue()
        self.notifications: list[dict] = []
        self.number = 0
        self.version = 0
        threading.Thread(target=self._read, daemon=True).start()
        general = {"positionEncodings": list(offered)} if offered else {}
        self.capabilities = self.ask(
            "initialize", {"processId": None, "rootUri": None, "capabilities": {"general": general}}
        )["capabilities"]
        self.tell("initialized", {})

    def _read(self) -> None:
        stream = self.process.stdout
        while header := stream.readline():
            length = int(header.split(b":")[1]) if header.lower().startswith(b"content-length") else 0
            while stream.readline().strip():
                pass
            self.messages.put(json.loads(stream.read(length)))
        self.messages.put(None)

    def _send(self, message: dict) -> None:
        body = json.dumps({"jsonrpc": "2.0", **message}, ensure_ascii=False).encode("utf-8")
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def tell(self, method: str, params: object) -> None:
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: object) -> object:
        """The result of a request. AssertionError for an error or silence."""
        self.number += 1
        self._send({"id": self.number, "method": method, "params": params})
        while True:
            message = self.messages.get(timeout=WAIT_S)
            assert message is not None, "the server ended"
            if message.get("id") == self.number and "method" not in message:
                assert "error" not in message, message["error"]
                return message["result"]
            self.notifications.append(message)

    def diagnostics(self, uri: str, version: int | None = None) -> list[dict]:
        """The next diagnostics of a document that were not taken yet."""
        while True:
            for number, message in enumerate(self.notifications):
                if message.get("method") == "textDocument/publishDiagnostics":
                    params = message["params"]
                    if params["uri"] == uri and version in (None, params.get("version")):
                        del self.notifications[: number + 1]
                        return params["diagnostics"]
            message = self.messages.get(timeout=WAIT_S)
            assert message is not None, "the server ended"
            self.notifications.append(message)

    def open(self, uri: str, text: str) -> list[dict]:
        """Open a document; its diagnostics."""
        self.version = 1
        document = {"uri": uri, "languageId": "trg", "version": 1, "text": text}
        self.tell("textDocument/didOpen", {"textDocument": document})
        return self.diagnostics(uri)

    def change(self, uri: str, *texts: str) -> int:
        """Replace the text of a document, one change after the other; the last version."""
        for text in texts:
            self.version += 1
            document = {"uri": uri, "version": self.version}
            changes = [{"text": text}]
            self.tell("textDocument/didChange", {"textDocument": document, "contentChanges": changes})
        return self.version

    def at(self, method: str, uri: str, line: int, character: int) -> object:
        """The answer to a request about a position (from 0, in the client's units)."""
        place = {"textDocument": {"uri": uri}, "position": {"line": line, "character": character}}
        return self.ask(f"textDocument/{method}", place)

    def close(self) -> int:
        """Shut the server down; its exit code."""
        self.ask("shutdown", None)
        self.tell("exit", None)
        code = self.process.wait(timeout=WAIT_S)
        for stream in (self.process.stdin, self.process.stdout, self.process.stderr):
            stream.close()
        return code
