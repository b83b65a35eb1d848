/** One study: how far it is, and what it says. */

import { Button, Collapse, Text } from "@mantine/core";
import { useDisclosure, useDocumentTitle } from "@mantine/hooks";
import { IconAdjustments, IconPlus } from "../icons";
import { useQuery } from "@tanstack/react-query";
import { Link, useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import { isNotFound, isTransient } from "../api/problem";
import { BatchState } from "../batch/BatchState";
import { otherThanPaper } from "../origin/otherThanPaper";
import { BATCH, useJob } from "../jobs/useJob";
import { Blank, CouldNotLoad } from "../shell/Blank";
import { ShellSlot } from "../shell/slots";
import shell from "../shell/shell.module.css";
import { useCatalogues } from "../state/useCatalogues";
import { defaultsQuery } from "./defaults";
import { StudyForm } from "./StudyForm";
import { StudyResults } from "./StudyResults";
import ui from "../ui/ui.module.css";
import { compact } from "../ui/compact";
import { Loading } from "../ui/Loading";

export function StudyPage() {
  const { id } = useParams({ from: "/robustness/$id" });
  const { job: batch, error, connected, left } = useJob(BATCH, id);
  const { catalogues, fault: catalogueFault } = useCatalogues();
  const defaults = useQuery(defaultsQuery);
  const [changing, { toggle }] = useDisclosure(false);
  useDocumentTitle("Robustness study · Ridelab");

  const strategies = catalogues?.strategies;
  const studied = useMemo(() => strategies?.filter(({ id }) => batch?.strategies.some((each) => each === id)) ?? [], [strategies, batch?.strategies]);
  const fault = [error, defaults.error].find((each) => each !== null && !isTransient(each)) ?? catalogueFault;

  return (
    <>
      <ShellSlot name="tools">
        <span className={shell.grow} />
          {batch && defaults.data && (
            <Button size="xs" variant="default" aria-expanded={changing} aria-label="Change it" classNames={compact} leftSection={<IconAdjustments size={15} />} onClick={toggle}>
              Change it
            </Button>
          )}
          <Button size="xs" variant="default" aria-label="New study" classNames={compact} leftSection={<IconPlus size={15} />} renderRoot={(props) => <Link to="/robustness" {...props} />}>
            New study
          </Button>
      </ShellSlot>
      <main className={ui.main}>
        {fault ? (
          isNotFound(error) ? (
            <Blank title="There is no study at this address" text="The address may be incomplete, or the study was made on another server.">
              <Button renderRoot={(props) => <Link to="/robustness" {...props} />}>New study</Button>
            </Blank>
          ) : (
            <CouldNotLoad what="study" message={fault.message} />
          )
        ) : batch && catalogues && defaults.data ? (
          <>
            <h1 className={ui.title}>Robustness</h1>
            <Collapse expanded={changing}>
              <StudyForm
                defaults={defaults.data}
                strategies={catalogues.strategies}
                form={catalogues.form}
                scenario={batch.scenario}
                existing={batch}
                head={
                  <Text size="sm">
                    The scenario of this study. <Text span c="dimmed">{otherThanPaper(batch.scenario, catalogues.form)}</Text>
                  </Text>
                }
              />
            </Collapse>
            <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={false} />
            <StudyResults batch={batch} {...catalogues} strategies={studied} />
          </>
        ) : (
          <Loading label="Loading the study" heights={[28, 96, 440, 320]} />
        )}
      </main>
    </>
  );
}
