/** One study: how far it is, and what it says. */

import { Button, Collapse, Text } from "@mantine/core";
import { useDisclosure } from "@mantine/hooks";
import { useSuspenseQuery } from "@tanstack/react-query";
import { Link, useParams } from "@tanstack/react-router";
import { useMemo } from "react";
import { Icon } from "../../ui/icons";
import { BatchFiles } from "../../features/export/FileMenu";
import { BatchState } from "../../features/sweep/SweepState";
import { otherThanPaper } from "../../features/scenarioSource/otherThanPaper";
import { BATCH, useJob } from "../../jobs/useJob";
import { Page } from "../../ui/Page";
import { uncertaintiesQuery } from "../../server/queries";
import { useCatalogues } from "../../server/useCatalogues";
import { StudyForm } from "./StudyForm";
import { StudyResults } from "./StudyResults";
import { compact } from "../../ui/IconButton";
import { ShareAddress } from "../../features/share/ShareLink";

export function StudyPage() {
  const { id } = useParams({ from: "/robustness/$id" });
  const { job: batch, connected, left } = useJob(BATCH, id);
  const catalogues = useCatalogues();
  const defaults = useSuspenseQuery(uncertaintiesQuery).data;
  const [changing, { toggle }] = useDisclosure(false);

  const { strategies } = catalogues;
  const ids = batch.strategies;
  const studied = useMemo(() => strategies.filter((each) => ids.some((id) => id === each.id)), [strategies, ids]);
  const tools = (
    <>
      <Button
        aria-expanded={changing}
        aria-label="Change it"
        classNames={compact}
        leftSection={<Icon name="Adjustments" size={15} />}
        onClick={toggle}
      >
        Change it
      </Button>
      <Button
        aria-label="New study"
        classNames={compact}
        leftSection={<Icon name="Plus" size={15} />}
        renderRoot={(props) => <Link to="/robustness" {...props} />}
      >
        New study
      </Button>
      <ShareAddress what="study" ready />
      <BatchFiles batch={batch} />
    </>
  );
  return (
    <Page title="Robustness study" heading="Robustness" tools={tools}>
      <Collapse expanded={changing}>
        <StudyForm
          defaults={defaults}
          strategies={catalogues.strategies}
          form={catalogues.form}
          scenario={batch.scenario}
          existing={batch}
          head={
            <Text>
              The scenario of this study.{" "}
              <Text span c="dimmed">
                {otherThanPaper(batch.scenario, catalogues.form)}
              </Text>
            </Text>
          }
        />
      </Collapse>
      <BatchState {...{ batch, connected, left }} form={catalogues.form} readOnly={false} />
      <StudyResults batch={batch} {...catalogues} strategies={studied} />
    </Page>
  );
}
