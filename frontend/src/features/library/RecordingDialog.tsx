/** Before a recorded drive is sent: what each column of its file is read as. */

import { Button, Group, Modal, NativeSelect, Text, TextInput } from "@mantine/core";
import { useSelector } from "@tanstack/react-store";
import { useState } from "react";
import { ask } from "../../api/http";
import { messageOf } from "../../api/problem";
import { useLabContext } from "../../lab/context";
import { nameRecording } from "../../lab/recordings";
import { useCatalogue } from "../../server/useCatalogues";
import ui from "../../ui/ui.module.css";
import classes from "./library.module.css";
import { notice } from "./open";
import { recordedFile, type RecordedFile } from "./recordedFile";

export function RecordingDialog() {
  const file = useSelector(recordedFile);
  return file && <Columns key={file.name} file={file} onClose={() => recordedFile.set(null)} />;
}

interface Choice {
  readonly signal: string;
  readonly unit: string;
}

function Columns({ file, onClose }: { readonly file: RecordedFile; readonly onClose: () => void }) {
  const { lab } = useLabContext();
  const { signals } = useCatalogue();
  const { columns, rows, message } = file.preview;
  const [choices, setChoices] = useState<readonly Choice[]>(
    columns.map(({ signal, unit }) => ({ signal: signal ?? "", unit })),
  );
  const [wrong, setWrong] = useState(message);
  const [sending, setSending] = useState(false);
  const choose = (index: number, part: Partial<Choice>) => {
    setWrong(null);
    setChoices((all) => all.map((each, at) => (at === index ? { ...each, ...part } : each)));
  };
  const unitOf = (key: string) => signals.find((signal) => signal.key === key)?.unit ?? "";
  const send = async () => {
    setSending(true);
    try {
      const mapping = columns.flatMap(({ name }, index) => {
        const { signal = "", unit = "" } = choices[index] ?? {};
        return [[name, signal && `${signal} [${unit}]`] as const];
      });
      const query = { columns: JSON.stringify(Object.fromEntries(mapping)) };
      const sent = await ask("post", "/recordings", { body: file.csv, query });
      nameRecording(sent.strategy, file.name);
      const { history, strategies } = lab.get();
      lab.setStrategies([...strategies.filter((id) => id !== sent.strategy), sent.strategy]);
      if (history)
        notice.set({
          lines: [`“${file.name}” is shown.`, ...sent.warnings],
          isWrong: false,
          scenario: history.present,
        });
      onClose();
    } catch (error) {
      setWrong(messageOf(error));
      setSending(false);
    }
  };
  return (
    <Modal opened onClose={onClose} title={`Recorded drive “${file.name}”`} size="xl">
      <Text size="sm" mb="sm">
        What each column is, and its unit. Position and clock need not fit: the drive is placed on this road where it is
        like a simulated one.
      </Text>
      <table className={classes.columns}>
        <thead>
          <tr>
            <th scope="col">Column</th>
            <th scope="col">Signal</th>
            <th scope="col">Unit</th>
            <th scope="col">First values</th>
          </tr>
        </thead>
        <tbody>
          {columns.map(({ name }, index) => (
            <tr key={`${index} ${name}`}>
              <th scope="row">{name || `Column ${index + 1}`}</th>
              <td>
                <NativeSelect
                  aria-label={`Signal of ${name}`}
                  size="xs"
                  value={choices[index]?.signal ?? ""}
                  data={[{ value: "", label: "left out" }, ...signals.map(({ key, label }) => ({ value: key, label }))]}
                  onChange={({ currentTarget: { value } }) =>
                    choose(index, { signal: value, ...(choices[index]?.unit ? {} : { unit: unitOf(value) }) })
                  }
                />
              </td>
              <td>
                <TextInput
                  aria-label={`Unit of ${name}`}
                  size="xs"
                  w={90}
                  disabled={!choices[index]?.signal}
                  value={choices[index]?.unit ?? ""}
                  onChange={({ currentTarget: { value } }) => choose(index, { unit: value })}
                />
              </td>
              <td>
                {rows
                  .slice(0, 3)
                  .map((row) => row[index])
                  .join("  ")}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {wrong !== null && (
        <Text role="alert" size="sm" mt="sm" className={ui.warning ?? ""}>
          {wrong}
        </Text>
      )}
      <Group justify="flex-end" mt="md">
        <Button variant="default" onClick={onClose}>
          Cancel
        </Button>
        <Button variant="filled" loading={sending} onClick={() => void send()}>
          Show the drive
        </Button>
      </Group>
    </Modal>
  );
}
