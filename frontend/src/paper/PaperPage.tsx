/** The paper, checked: what it prints beside what comes out here. */

import { useDocumentTitle } from "@mantine/hooks";
import { PageHeader } from "../shell/PageHeader";
import shell from "../shell/shell.module.css";

export function PaperPage() {
  useDocumentTitle("The paper, checked · Ridelab");
  return (
    <div className={shell.shell}>
      <PageHeader />
    </div>
  );
}
