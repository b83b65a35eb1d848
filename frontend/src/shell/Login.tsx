/** Asks once for the token that the service wants. */

import { Button, PasswordInput } from "@mantine/core";
import { useState, type SyntheticEvent } from "react";
import { login } from "../api/login";
import { Blank } from "./Blank";
import classes from "./shell.module.css";

export function Login() {
  const [token, setToken] = useState("");
  const [busy, setBusy] = useState(false);
  const [error, setError] = useState<string | null>(null);
  const submit = async (event: SyntheticEvent) => {
    event.preventDefault();
    setBusy(true);
    try {
      await login.logIn(token.trim());
      window.location.reload();
    } catch (reason) {
      setError(reason instanceof Error ? reason.message : "It could not be sent");
      setBusy(false);
    }
  };
  return (
    <Blank title="Ridelab asks for a token" text="This service requires a token. The browser then stores a cookie for 90 days.">
      <form className={classes.login} onSubmit={(event) => void submit(event)}>
        <PasswordInput
          label="Token"
          value={token}
          error={error}
          autoFocus
          autoComplete="current-password"
          onChange={(event) => setToken(event.currentTarget.value)}
        />
        <Button type="submit" loading={busy} disabled={token.trim() === ""}>
          Log in
        </Button>
      </form>
    </Blank>
  );
}
