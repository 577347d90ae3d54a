// Starts the web app, once the texts of its language are there.
import { mount } from 'svelte';
import { loadTexts } from '../language/main.loader';
import '../ui/style/base.css';
import App from './App.svelte';

const target = document.getElementById('app');
if (target === null) throw new Error('index.html has no #app');
void loadTexts().then(() => mount(App, { target }));
