// Starts the page: a batch, a take with controls, or a report, depending on its data.

import 'uplot/dist/uPlot.min.css';
import './style.css';
import { showBatch, type Batch } from './batch_page';
import { jsonOf } from './codec';
import { element } from './dom';
import type { ReportDocument, TakeData } from './report';
import { Take } from './take';
import { showTake } from './take_page';
import type { Session } from './served';
import { startView } from './view';

async function start(): Promise<void> {
  const page = document.getElementById('page') as HTMLElement;
  try {
    const batch = await jsonOf<Batch>('batch');
    if (batch !== null) return showBatch(page, batch);
    const view = await jsonOf<Session>('view');
    if (view !== null) {
      startView(page, view);
      return;
    }
    const report = await jsonOf<ReportDocument>('report');
    const take = await jsonOf<TakeData>('take');
    if (report === null || take === null) throw new Error('the page contains no report');
    await showTake(page, report, await Take.load(take));
    page.dataset.ready = 'true';
  } catch (error) {
    page.replaceChildren(element('h1', {}, 'This report cannot be shown'), element('p', {}, String(error)),
      element('p', {}, 'The page needs a browser of 2023 or later, and the file must be complete.'));
    page.dataset.ready = 'failed';
  }
}

void start();
