/** One study: how far it is, and what it says. */

import { Button, Collapse, Text } from "@mantine/core";
import { useDisclosure, useDocumentTitle } from "@mantine/hooks";
import { IconAdjustments, IconPlus } from "../icons";
import { useQuery, useQueryClient } from "@tanstack/react-query";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import { BatchFault, BatchLoading } from "../batch/BatchBlank";
import { BatchState } from "../batch/BatchState";
import { figuresOf } from "../batch/figures";
import { otherThanPaper } from "../origin/otherThanPaper";
import { BATCH, useJob } from "../jobs/useJob";
import { Blank } from "../shell/Blank";
import { ConnectionBanner } from "../shell/ConnectionBanner";
import { PageHeader } from "../shell/PageHeader";
import shell from "../shell/shell.module.css";
import { catalogueQuery, figuresQuery, schemaQuery, strategiesQuery } from "../state/queries";
import { defaultsQuery } from "./defaults";
import classes from "./robustness.module.css";
import { StudyForm } from "./StudyForm";
import { StudyResults } from "./StudyResults";

const compact = { root: shell.compact ?? "", label: shell.compactLabel ?? "", section: shell.compactSection ?? "" };

export function StudyPage({ id }: { readonly id: string }) {
  const queries = useQueryClient();
  const { job: batch, error, connected, left } = useJob(BATCH, id);
  const strategies = useQuery(strategiesQuery);
  const catalogue = useQuery(catalogueQuery);
  const templates = useQuery(figuresQuery);
  const form = useQuery(schemaQuery);
  const defaults = useQuery(defaultsQuery);
  const [changing, { toggle }] = useDisclosure(false);
  useDocumentTitle("Robustness study · Ridelab");

  const figures = useMemo(() => (catalogue.data && templates.data ? figuresOf(catalogue.data, templates.data) : null), [catalogue.data, templates.data]);
  const studied = useMemo(() => (strategies.data ?? []).filter(({ id }) => batch?.strategies.some((each) => each === id)), [strategies.data, batch?.strategies]);
  const fault = [error, strategies.error, catalogue.error, templates.error, form.error, defaults.error].find((each) => each !== null && !isTransient(each));

  return (
    <div className={shell.shell}>
      <PageHeader>
        {batch && defaults.data && (
          <Button size="xs" variant="default" aria-expanded={changing} aria-label="Change it" classNames={compact} leftSection={<IconAdjustments size={15} />} onClick={toggle}>
            Change it
          </Button>
        )}
        <Button component="a" href="/robustness" size="xs" variant="default" aria-label="New study" classNames={compact} leftSection={<IconPlus size={15} />}>
          New study
        </Button>
      </PageHeader>
      <main className={classes.main}>
        {fault ? (
          isNotFound(error) ? (
            <Blank title="There is no study at this address" text="The address may be cut short, or the study was made on another server.">
              <Button component="a" href="/robustness">
                New study
              </Button>
            </Blank>
          ) : (
            <BatchFault message={fault.message} onRetry={() => void queries.refetchQueries()} />
          )
        ) : batch && figures && catalogue.data && form.data && defaults.data && strategies.data ? (
          <>
            <h1 className={classes.title}>Robustness</h1>
            <Collapse expanded={changing}>
              <StudyForm
                defaults={defaults.data}
                strategies={strategies.data}
                form={form.data}
                scenario={batch.scenario}
                made={batch}
                head={
                  <Text size="sm">
                    The scenario of this study. <Text span c="dimmed">{otherThanPaper(batch.scenario, form.data)}</Text>
                  </Text>
                }
              />
            </Collapse>
            <BatchState {...{ batch, connected, left }} form={form.data} readOnly={false} />
            <StudyResults {...{ batch, figures }} strategies={studied} catalogue={catalogue.data} />
          </>
        ) : (
          <BatchLoading />
        )}
      </main>
      <div className={shell.notices} style={{ left: 0 }}>
        <ConnectionBanner />
      </div>
    </div>
  );
}
