/** Asks once for the token that the service wants, which it keeps in a cookie so that event streams and downloads send it along. */

import { Button, PasswordInput, Stack } from "@mantine/core";
import { useMutation } from "@tanstack/react-query";
import { useState } from "react";
import { ask } from "../api/http";
import { submits } from "../ui/ListEntry";
import { Blank } from "../ui/Page";

export function Login() {
  const [token, setToken] = useState("");
  const login = useMutation({
    mutationFn: () => ask("post", "/login", { body: { token: token.trim() } }),
    onSuccess: () => window.location.reload(),
  });
  return (
    <Blank
      title="Ridelab asks for a token"
      text="This service requires a token. The browser then stores a cookie for 90 days."
    >
      <Stack component="form" gap="0.6rem" w="min(20rem, 100%)" onSubmit={submits(() => login.mutate())}>
        <PasswordInput
          label="Token"
          value={token}
          error={login.error?.message}
          autoFocus
          autoComplete="current-password"
          onChange={(event) => setToken(event.currentTarget.value)}
        />
        <Button
          size="sm"
          variant="filled"
          type="submit"
          loading={login.isPending || login.isSuccess}
          disabled={token.trim() === ""}
        >
          Log in
        </Button>
      </Stack>
    </Blank>
  );
}
