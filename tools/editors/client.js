// Starts `trg lsp` for TRG files and passes its answers on to the editor.
"use strict";

const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = function activate() {
  const [command, ...args] = workspace.getConfiguration("trg").get("command");
  const documents = { documentSelector: [{ language: "trg" }] };
  client = new LanguageClient("trg", "TRG", { command, args }, documents);
  return client.start();
};

exports.deactivate = function deactivate() {
  return client === undefined ? undefined : client.stop();
};
