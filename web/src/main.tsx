import './style.css';

import { render } from 'preact';

import { App } from './app';
import { copyTablesClean } from './lib/table_copy';

copyTablesClean();
render(<App />, document.getElementById('page')!);
